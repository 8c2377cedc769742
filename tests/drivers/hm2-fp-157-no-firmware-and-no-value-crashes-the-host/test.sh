#!/bin/bash
# FP-157: random firmware, pins and registers, transfers that fail now and then, and pins with nan, inf and extremes
# never end the realtime process; a board either works or is refused.
top=$(cd ../../.. && pwd)
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_wild_board.c t.hal "$rtlib/kerf_wild_board.so"' EXIT
{ echo "#define BOARD_HEADER \"$top/src/hal/drivers/mesa-hostmot2/hm2_llio.h\""; cat wild_board.c; } > kerf_wild_board.c
EXTRA_CFLAGS="-I$top/src/hal" halcompile --install kerf_wild_board.c >&2 || exit 1
export KERF_CLOCK=virtual
for first in ${FIRST:-1 21 41 61 81}; do
    printf 'loadrt hostmot2\nloadrt kerf_wild_board first=%d seeds=20\nloadusr -w sh wild.sh\n' "$first" > t.hal
    cat > wild.sh <<'END'
halcmd loadrt threads name1=t period1=1000000
halcmd show funct b 2>/dev/null | awk '$6 ~ /^b[0-9]+[.](read|write|read_gpio|write_gpio)$/ { print "addf", $6, "t" }' |
    sort > c.hal
echo start >> c.hal
for value in nan inf -inf 1e300 -1e300 0 1; do
    { halcmd show pin b; halcmd show param b; } 2>/dev/null |
        awk -v v=$value '$3 ~ /IN|I\/O|RW/ && $5 ~ /^b[0-9]/ && $5 !~ /has_bit|timeout_ns|tmax/ {
            if($2 == "float") print "setp", $5, v
            if($2 == "u32") print "setp", $5, (v == 0 || v == 1 ? v : v ~ /-/ ? 7 : "4294967295")
            if($2 == "s32") print "setp", $5, (v == 0 || v == 1 ? v : v ~ /-/ ? "-2147483648" : "2147483647")
            if($2 == "bit") print "setp", $5, (v != 0) }' >> c.hal
    echo "loadusr -w kerf-clock sleep 0.05" >> c.hal
done
halcmd -k -f c.hal > /dev/null 2>&1
halcmd getp t.threadbeat | awk '{ print ($1 > 300 ? "the thread still runs" : "it stopped") }'
END
    halrun -f t.hal 2> told | grep -E 'boards|thread|stopped'
    grep -ci 'signal\|assert\|fault.*core\|died' told
done
rm -f wild.sh c.hal told
