#!/bin/bash
# What setp and sets take, what getp, gets, show and save print, for every type. Ports.
{
echo "loadrt conv_s32_u32"
echo "loadrt conv_float_s64"
echo "loadrt conv_u64_bit"
} > t.hal
try() { # type value...
    local type=$1 v
    shift
    for v in "$@"; do
        printf 'print %s:<%s>\nsets %s %s\ngets %s\n' "$type" "$v" "$type" "$v" "$type"
    done
}
{
for t in bit float s32 u32 s64 u64; do echo "newsig $t $t"; done
try bit 1 0 TRUE false On oFF yes NO 2 -1 tru '" 1"' nan
try float 1 -2.5 1e3 0x1p4 inf -INF nan 1e400 1e-400 .5 5. 1,5 1.0.0 abc 3junk 123456789.125
try s32 0 -1 +7 0x10 010 2147483647 -2147483648 2147483648 -2147483649 99999999999999999999 3.0 12x 0x '-'
try u32 0 4294967295 4294967296 -1 0xffffffff 1.5 junk
try s64 9223372036854775807 -9223372036854775808 9223372036854775808 0x7fffffffffffffff 1e3
try u64 18446744073709551615 18446744073709551616 -1 0xffffffffffffffff
echo "show sig"
echo "save sig"
for t in bit float s32 u32 s64 u64; do echo "stype $t"; done
echo "setp conv-s32-u32.0.in -5"
echo "setp conv-s32-u32.0.in 5000000000"
echo "setp conv-s32-u32.0.out 5"
echo "setp conv-s32-u32.0.tmax 7"
echo "setp conv-s32-u32.0.tmax-increased 1"
echo "setp none 1"
echo "conv-s32-u32.0.in = 6"
echo "getp conv-s32-u32.0.in"
echo "net s32 conv-s32-u32.0.in"
echo "setp conv-s32-u32.0.in 8"
echo "getp conv-s32-u32.0.in"
echo "sets s32 8"
echo "getp conv-s32-u32.0.in"
echo "net u32 conv-s32-u32.0.out"
echo "sets u32 9"
echo "ptype conv-s32-u32.0.out"
echo "save param"
echo "save unconnectedinpins"
} >> t.hal
halrun -k t.hal 2>err.txt; echo "=> $?"
grep -v '^Note\|^  \|^No isol' err.txt
echo "# words with blanks (one argument)"
realtime start > log.txt 2>&1
halcmd newsig n s32; halcmd newsig b bit
halcmd sets n '12 junk'; halcmd gets n
halcmd sets n ' 13'; halcmd gets n
halcmd sets n '' 2>&1
halcmd sets b ' 1' 2>&1
echo "# ports"
halcmd newsig p port
halcmd gets p 2>&1 | sed 's/0x[0-9a-f]*/ADDRESS/'
halcmd sets p 0 2>&1; halcmd sets p 65537 2>&1; halcmd sets p junk 2>&1
halcmd sets p 100; halcmd gets p
halcmd sets p 200 2>&1; halcmd sets p 0 2>&1
halcmd stype p
halcmd save sig
halcmd unload all
realtime stop
rm -f t.hal err.txt log.txt
