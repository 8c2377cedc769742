#!/bin/bash
# A window that nobody touches ends at a signal, without a word, also while a box waits for an answer.
export HOME=$PWD/home INI_FILE_NAME=
mkdir home
printf '[KINS]\nJOINTS = 1\n[HAL]\nHALFILE = t.hal\n[TUNE]\nF = 1\n' > t.ini
echo 'setp siggen.0.frequency [TUNE]F' > t.hal
realtime start 2> /dev/null
halcmd loadrt siggen num_chan=1

# ended SIGNAL TITLE COMMAND...: once a window of this title is there; then=KEY box=TITLE: a key that brings a box, before it.
ended() {
    signal=$1 title=$2; shift 2
    "$@" > out 2>&1 & pid=$!
    timeout 30 xdotool search --sync --onlyvisible --name "$title" > /dev/null
    sleep 0.3
    [ -z "$then" ] || { xdotool key $then; timeout 30 xdotool search --sync --onlyvisible --name "$box" > /dev/null; sleep 0.3; }
    kill -s "$signal" $pid
    for i in $(seq 50); do kill -0 $pid 2> /dev/null || break; sleep 0.1; done
    kill -9 $pid 2> /dev/null && echo "killed"
    wait $pid 2> /dev/null; echo "$* $then $signal: status $?"; cat out
}
export -f ended
"$TEST_DIR/../../lib/with-display" bash -c '
    ended TERM "LinuxCNC Calibration" emccalib -ini t.ini
    ended HUP "LinuxCNC Calibration" emccalib -ini t.ini
    ended HUP "Configuration Selector" /usr/bin/python3 -m kerf.pickconfig
    then=ctrl+k box=ngcgui ended HUP ngcgui ngcgui
    ended TERM "LinuxCNC Calibration" emccalib -ini none.ini
    for program in hal_manualtoolchange halmeter halshow halconfig; do ended TERM . $program; done
    ended TERM . halscope
    ended TERM . sim_pin siggen.0.frequency
'
realtime stop 2> /dev/null
rm -rf home out t.ini t.hal autosave.halscope
