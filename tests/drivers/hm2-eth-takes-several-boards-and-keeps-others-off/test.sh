#!/bin/bash
# Two boards in one thread, asked together and then read, and one that no table knows; firewall rules as documented,
# with programs of these names that only write down what they were asked, and taken away at the end.
. ../../lib/hm2-address
first=$hm2_address second=${hm2_address%.*}.251 third=${hm2_address%.*}.252
scratch=$(mktemp -d)
trap 'rm -rf "$scratch" t.hal' EXIT
for program in iptables ip6tables nft; do
    cat > "$scratch/$program" <<END
#!/bin/sh
echo "$program \$*" >> "$scratch/asked"
case "$program \$*" in "iptables -C"*|"ip6tables -C"*) exit 1;; esac
[ -e "$scratch/no-$program" ] && exit 1 || exit 0
END
    chmod +x "$scratch/$program"
done
coproc BOARDS {
    exec 3<&0
    for each in "$first 7I96S" "$second 7I96S" "$third litehm2"; do
        /usr/bin/python3 ../../lib/hm2_board.py $each <&3 &
    done
    wait
}
for _ in 1 2 3; do read -r line <&"${BOARDS[0]}"; done
export KERF_CLOCK=virtual PATH=$scratch:$PATH
cat > t.hal <<END
loadrt hostmot2
loadrt hm2_eth board_ip=$first,$second,$third config=enable_raw,num_stepgens=1 firewall=\$(FIREWALL)
END
board=(hm2_7i96s.0 hm2_7i96s.1 hm2_lite.0)
{
    echo 'loadrt threads name1=servo period1=1000000'
    for b in "${board[@]}"; do echo "setp $b.packet-read-timeout 2000000000"; echo "addf $b.read-request servo"; done
    for b in "${board[@]}"; do echo "addf $b.read servo"; done
    for b in "${board[@]}"; do echo "addf $b.write servo"; done
    printf 'setp hm2_7i96s.1.gpio.002.is_output 1\nsetp hm2_7i96s.1.gpio.002.out 1\n'
    printf 'setp hm2_lite.0.gpio.001.is_output 1\n'
    printf 'setp hm2_lite.0.gpio.001.out 1\nstart\nloadusr -w kerf-clock sleep 0.1\n'
    for b in "${board[@]}"; do
        printf 'getp %s.gpio.001.in\ngetp %s.gpio.002.in\ngetp %s.packet-error-total\ngetp %s.watchdog.has_bit\n' \
            "$b" "$b" "$b" "$b"
    done
} >> t.hal
try() {
    : > "$scratch/asked"
    echo "firewall=$1"
    FIREWALL=$1 halrun -f t.hal 2> "$scratch/told" | grep -E '^(TRUE|FALSE|[0-9])' | tr '\n' ' '
    echo
    sed -E "s/$first/FIRST/; s/$second/SECOND/; s/$third/THIRD/; s/--sport [0-9]+/--sport N/; s/sport [0-9]+/sport N/" \
        "$scratch/asked" | sed -E 's/127[.0-9]+/LOCAL/'
    grep -E 'firewall|restrict|Unrecog' "$scratch/told" | sort
}
try auto
try iptables
try nft
touch "$scratch/no-iptables" "$scratch/no-nft"
try iptables
try wall
printf 'x' >&"${BOARDS[1]}"
exec {BOARDS[1]}>&-
wait
