# part-for.sh FOLDER/NAME PART: the random operator's part, for another machine.
case $1 in
lathe*) sed 's/Y0 Z50/Z5/; s/X20/X12/; /Y/d; s/^G21/G18 G8 G21/; s/^G2 .*/G1 Z-3/' "$2" ;;
foam*) sed 's/X0 Y0 Z50/X5 Y5 U5 V5/; s/^G1 Y10/G1 Y10 V8/; s/^G1 X20/G1 X20 U15/; /^M3/d; /^T1/d; s/^G2 .*/G1 X6 U6/' "$2" ;;
gantry*) sed 's/Z50/Z-5/' "$2" ;;
fiveaxis*) sed 's/^G1 Y10/G1 Y10 C20/' "$2" ;;
*) cat "$2" ;;
esac
