#!/bin/bash
# hm2_pci, hm2_spi and hm2_spix, built here on a slot and a bus that are memory: the board is found by what it says,
# its pins drive its registers; boards that do not answer, are unknown or damaged in transfer are told, and io_error
# stops all.
top=$(cd ../../.. && pwd)
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_*.c t.hal told "$rtlib"/kerf_{slot,bus,busx,rpbus,port}.so' EXIT
build() { # module source driver
    { echo "#define DRIVER \"src/hal/drivers/mesa-hostmot2/$3\""; cat "$2"; } > "$1.c"
    EXTRA_CFLAGS="-I$top -I$top/src/hal -I$top/src/hal/drivers/mesa-hostmot2" halcompile --install "$1.c" >&2 || exit 1
}
build kerf_slot pci.c hm2_pci.c
build kerf_bus spi.c hm2_spi.c
sed 's/kerf_bus/kerf_busx/' spi.c > kerf_spix.c
build kerf_busx kerf_spix.c hm2_spix.c
export KERF_CLOCK=virtual
run() {
    halrun -f t.hal 2> told | grep -vE '^Note|loading|IO Pin 0[1-4]|IO Pin 05[0-5]'
    grep -vE '^Note|not loaded|<commandline>|waitpid|exited without' told | sed 's/^/told: /; s/t.hal:[0-9]*/t.hal/'
}
drive() { # module board words
    cat > t.hal <<END
loadrt hostmot2
loadrt $1 $3
loadrt threads name1=t period1=1000000
addf $2.read t
addf $2.write t
start
setp $2.gpio.003.is_output 1
setp $2.gpio.003.out 1
setp $2.raw.read_address 0x1100
loadusr -w kerf-clock sleep 0.01
getp $2.raw.read_data
setp $2.raw.read_address 0x0C00
loadusr -w kerf-clock sleep 0.01
getp $2.raw.read_data
END
}
echo "a slot"
drive kerf_slot hm2_5i25.0 config=enable_raw
echo 'show funct hm2' >> t.hal
run | grep -v 'CodeAddr' | sed -E 's/^ *[0-9]{5} +[0-9a-f]+ +[0-9a-f]+ +//'
drive kerf_slot hm2_5i25.0 plx=1
run | grep -E 'told|registered'
echo "SPI"
drive kerf_bus hm2_7c81.0 config=enable_raw
cat >> t.hal <<END
setp hm2_7c81.0.raw.write_address 0xF000
setp hm2_7c81.0.raw.write_data 1
setp hm2_7c81.0.raw.write_strobe 1
loadusr -w kerf-clock sleep 0.01
getp hm2_7c81.0.io_error
setp hm2_7c81.0.io_error 0
loadusr -w kerf-clock sleep 0.01
getp hm2_7c81.0.io_error
END
run
for path in /dev/spidev9.0 /dev/spidev3.0 /dev/spidev4.0; do
    printf 'loadrt hostmot2\nloadrt kerf_bus spidev_path=%s spidev_rate=1000\n' $path > t.hal
    run | grep -v unload
done
echo "SPI by place"
drive kerf_busx hm2_7c81.1 "config=enable_raw,enable_raw spi_probe=17 \
spiclk_rate=10000,20000 spi_pull_miso=1 spi_noqueue=1"
run | grep -v 'IO Pin'
sed 's/kerf_bus/kerf_rpbus/' spi.c > kerf_rpspi.c
build kerf_rpbus kerf_rpspi.c hm2_rpspi.c
drive kerf_rpbus hm2_7c81.0 "config=enable_raw spi_probe=2 spi_pull_miso=2"
run | grep -v 'IO Pin'
for words in spi_probe=0 force_driver=spix_rpi5; do
    printf 'loadrt hostmot2\nloadrt kerf_busx %s\n' $words > t.hal
    run | grep -v unload
done
echo "a parallel port"
build kerf_port epp.c hm2_7i90.c
drive kerf_port hm2_7i90.0 "config=enable_raw ioaddr=0x378"
cat >> t.hal <<END
setp hm2_7i90.0.raw.write_address 0x7000
setp hm2_7i90.0.raw.write_data 1
setp hm2_7i90.0.raw.write_strobe 1
loadusr -w kerf-clock sleep 0.01
getp hm2_7i90.0.io_error
END
run | grep -v 'IO Pin'
drive kerf_port hm2_7i90.0 "config=enable_raw ioaddr=0x378 narrow=1"
run | grep -v 'IO Pin'
drive kerf_port hm2_7i90.0 "ioaddr=1"
run | grep insmod
