#!/bin/bash
# A wrong word in a config string, or more than the firmware has, ends the load with a text that names it.
for config in num_encoder=2 num_encoders=two num_encoders=-5 num_encoders=3 num_stepgens=5 num_pwmgens=0x3 \
    sserial_port_4=00 \
    ssi_chan_32=a%8u "ssi_chan_0=a%8u ssi_chan_0=b%8u" biss_chan_1= num_sserials=1 "num_leds=7 num_encoders=0"; do
    echo "config=$config"
    echo 'show comp' | ../../lib/with-hm2-board -c "$config" |
        grep -E 'told: (hm2|script: insmod)|RT +hm2_eth' | sed 's/ *[0-9]* *RT/RT/'
done
echo "no board there"
printf 'loadrt hostmot2\nloadrt hm2_eth board_ip=127.255.255.1 firewall=none\n' > t.hal
halrun -f t.hal 2>&1 | grep ERROR
printf 'loadrt hostmot2\nloadrt hm2_eth board_ip=7i96\n' > t.hal
halrun -f t.hal 2>&1 | grep ERROR
printf 'loadrt hostmot2\nloadrt hm2_eth board_mac=00:60\n' > t.hal
halrun -f t.hal 2>&1 | grep board_mac
printf 'loadrt hostmot2\nloadrt hm2_eth\nshow comp' > t.hal
halrun -f t.hal 2>&1 | grep -o 'RT *hm2_eth'
rm -f t.hal
