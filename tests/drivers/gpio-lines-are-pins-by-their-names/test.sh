#!/bin/bash
# hal_gpio on chips that are files: pins, parameters and functions; what is asked of the kernel, one call for all lines of
# a direction; pulses that reset ends; a chip that goes and comes back; rest at the end; and mistakes.
KERF_GPIO_CHIPS=$(realpath "$(mktemp -d)")
export KERF_GPIO_CHIPS KERF_CLOCK=virtual
trap 'rm -rf "$KERF_GPIO_CHIPS" t.hal' EXIT
cc -shared -fPIC -w -o "$KERF_GPIO_CHIPS/gpio.so" gpio.c || exit
cd_chips() { (cd "$KERF_GPIO_CHIPS" && "$@"); }
printf '%s\n' ID_SDA ID_SCL GPIO2 GPIO3 GPIO4 "GPIO5 spi0 CS0" GPIO6 GPIO7 > "$KERF_GPIO_CHIPS/gpiochip0"
printf '%s\n' EXP1 EXP2 GPIO2 > "$KERF_GPIO_CHIPS/gpiochip10"
ln -s gpiochip0 "$KERF_GPIO_CHIPS/gpiochip2"
run() { LD_PRELOAD="$KERF_GPIO_CHIPS/gpio.so" halrun -f t.hal 2>&1 | grep -vE "^Note|exited without|waitpid|not loaded" | sed "s,$KERF_GPIO_CHIPS,CHIPS,; s/t.hal:[0-9]*: //"; }
log() { cd_chips cat log; cd_chips rm -f log; }

echo "== pins, parameters and functions"
printf 'loadrt hal_gpio inputs=GPIO2,GPIO3 outputs=GPIO4\nshow pin hal_gpio\nshow param hal_gpio\nshow funct hal_gpio\n' > t.hal
printf '#!/bin/sh\necho "== $*" | tee -a log\n' > "$KERF_GPIO_CHIPS/mark"
chmod +x "$KERF_GPIO_CHIPS/mark"
names() { run | grep -v '\.time\b\|\.tmax\b' | awk '$3 ~ /IN|OUT|RW/ { print $2, $3, $4, $5 } $NF ~ /^hal_gpio.(read|write|reset)$/ { print "function", $NF }'; }
names
log
echo "== with lines of reset"
sed -i '1s/$/,GPIO7 reset=GPIO7/' t.hal
names | grep reset

echo "== flags of lines"
printf 'loadrt hal_gpio inputs=GPIO2,EXP1 outputs=GPIO3,GPIO4,EXP2,GPIO6,GPIO7 invert=GPIO4 opendrain=GPIO3,GPIO4 opensource=GPIO6 biasdisable=EXP1 pullup=GPIO2,GPIO3 pulldown=EXP2\n' > t.hal
cd_chips rm -f log
run
log

echo "== more lines than one request takes"
seq -f L%g 70 > "$KERF_GPIO_CHIPS/gpiochip11"
{
    echo "loadrt hal_gpio outputs=$(seq -s, -f L%g 70) reset=L66"
    printf 'setp hal_gpio.%s-out 1\n' L1 L66 L70
    printf '%s\n' "loadrt threads name1=t period1=1000000" "addf hal_gpio.write t" "addf hal_gpio.reset t" start "loadusr -w kerf-clock sleep 0.01"
} > t.hal
run
log | sed 's/ L[0-9]*=0//g; s/ L[0-9]* out 0,\?//g' | sort | uniq -c | awk '{ $1 = $1 > 1 ? "more than once" : "once"; print }'
cd_chips rm gpiochip11 gpiochip11.levels

echo "== levels"
cat > t.hal <<'END'
loadrt hal_gpio inputs=GPIO2,EXP1 outputs=GPIO3,GPIO4,GPIO6 invert=GPIO4,GPIO6 reset=GPIO6,GPIO3
loadrt threads name1=t period1=1000000
addf hal_gpio.read t
addf hal_gpio.write t
loadusr -w cp levels0 gpiochip0.levels
loadusr -w cp levels10 gpiochip10.levels
start
loadusr -w kerf-clock sleep 0.0101
getp hal_gpio.GPIO2-in
getp hal_gpio.GPIO2-in-not
getp hal_gpio.EXP1-in
getp hal_gpio.EXP1-in-not
setp hal_gpio.GPIO3-out 1
loadusr -w kerf-clock sleep 0.01
setp hal_gpio.GPIO4-out 1
loadusr -w kerf-clock sleep 0.01
loadusr -w ./mark pulses
addf hal_gpio.reset t
setp hal_gpio.reset_ns 900000
setp hal_gpio.GPIO6-out 1
loadusr -w kerf-clock sleep 0.002
getp hal_gpio.reset_ns
setp hal_gpio.GPIO3-out 0
setp hal_gpio.GPIO6-out 0
loadusr -w kerf-clock sleep 0.01
loadusr -w ./mark gone and back
loadusr -w touch gone
setp hal_gpio.GPIO3-out 1
loadusr -w kerf-clock sleep 0.01
getp hal_gpio.GPIO2-in
getp hal_gpio.EXP1-in-not
loadusr -w rm gone
loadusr -w kerf-clock sleep 0.001
getp hal_gpio.GPIO2-in
loadusr -w ./mark end
END
printf 0010 > "$KERF_GPIO_CHIPS/levels0"
printf 0 > "$KERF_GPIO_CHIPS/levels10"
cp t.hal "$KERF_GPIO_CHIPS"
cd "$KERF_GPIO_CHIPS" || exit
run > told
grep -v "^hal_gpio: " told
echo "-- told"
grep "^hal_gpio: " told
echo "-- set"
sed '/== end/q' log
tail -1 log
rm log
cd "$TEST_DIR" || exit

echo "== in simulated time, without chips, no line moves"
printf '%s\n' "loadrt hal_gpio inputs=ANY outputs=OTHER reset=OTHER" "loadrt threads name1=t period1=1000000" "addf hal_gpio.read t" \
    "addf hal_gpio.write t" "addf hal_gpio.reset t" "setp hal_gpio.OTHER-out 1" start "loadusr -w kerf-clock sleep 0.01" "getp hal_gpio.ANY-in" "getp hal_gpio.ANY-in-not" > t.hal
env -u KERF_GPIO_CHIPS halrun -f t.hal 2>&1 | grep -v ^Note

echo "== mistakes"
for words in "" "inputs=GPIO2,NONE outputs=NONE2" "inputs=GPIO5" "inputs=GPIO2 outputs=GPIO2" "outputs=GPIO2,GPIO2" \
    "inputs=GPIO2 invert=GPIO2" "inputs=GPIO2 pullup=GPIO3" "outputs=GPIO2 opendrain=GPIO2 opensource=GPIO2" \
    "inputs=GPIO2 pullup=GPIO2 biasdisable=GPIO2"; do
    echo "-- $words"
    echo "loadrt hal_gpio $words" > t.hal
    run
done
echo "-- a file that is no chip"
cd_chips mkdir gpiochip3
echo "loadrt hal_gpio inputs=GPIO9" > t.hal
run
echo "-- no chips"
cd_chips rm -rf gpiochip0 gpiochip2 gpiochip3 gpiochip10
run
