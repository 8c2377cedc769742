#!/bin/bash
# pyvcp_demo: a panel with a HAL file, in a session that ends with the panel; what is refused, and why.
cat > lamp.xml <<'XML'
<pyvcp><vbox><led halpin="'on'"/><number halpin="'speed'"/></vbox></pyvcp>
XML
printf 'loadrt mux2 names=choice\nsetp choice.in0 12.5\nloadrt threads name1=t period1=1000000\naddf choice t\nnet speed choice.out demo.speed\nstart\n' > lamp.hal
pyvcp_demo lamp.xml | head -2
pyvcp_demo none.xml lamp.hal 2>&1 | sed "s|$PWD/||"
../../lib/with-display bash -c 'pyvcp_demo lamp.xml lamp.hal demo & timeout 40 xdotool search --sync --onlyvisible --name demo > window
    for i in $(seq 100); do [ "$(halcmd getp demo.speed)" = 12.5 ] && break; sleep 0.1; done
    halcmd -s show pin demo.; pyvcp_demo lamp.xml lamp.hal; echo "second: $?"
    halcmd unloadusr demo; wait $!; echo "status $?"' 2>&1 | grep -v -i "Process capabilities\|setcap\|realtime scheduling\|Note:\|Falling\|Override\|isolated" | sed 's/^ *[0-9]* *//'
halcmd list comp demo 2> /dev/null
rm window lamp.xml lamp.hal
