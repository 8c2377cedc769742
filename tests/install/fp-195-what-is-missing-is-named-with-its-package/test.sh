#!/bin/bash
# FP-195: configure with parts of the system hidden: a compiler that does not find headers, a pkg-config that knows no libraries,
# programs that are not on PATH.
configure=$EMC2_HOME/configure
[ -x "$configure" ] || { echo "there is no configure in $EMC2_HOME"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/build"
cat > "$work/bin/no-headers" <<'END'
#!/bin/sh
for last; do :; done
for h in $HIDDEN; do
    [ -f "$last" ] && grep -q "#include <$h>" "$last" && { echo "$last: fatal error: $h: No such file" >&2; exit 1; }
done
exec "$(basename "$0" -hiding)" "$@"
END
chmod +x "$work/bin/no-headers"
for c in gcc g++; do ln -s no-headers "$work/bin/$c-hiding"; done
cat > "$work/bin/pkg-config" <<'END'
#!/bin/sh
for h in $HIDDEN; do case " $* " in *" $h "*) exit 1 ;; esac; done
exec /usr/bin/pkg-config "$@"
END
chmod +x "$work/bin/pkg-config"
# PATH without some programs
without() {
    rm -rf "$work/path" && mkdir "$work/path"
    for f in /usr/bin/* /bin/*; do ln -sf "$f" "$work/path/"; done
    for f; do rm -f "$work"/path/*"$f"; done
    PATH=$work/path
}
run() {
    (cd "$work/build" && "$configure" CC="$work/bin/gcc-hiding" CXX="$work/bin/g++-hiding" "$@" 2>&1 |
        sed -n 's/^configure: //; /^error: \|^left out\|^  /p')
}
export PKG_CONFIG=$work/bin/pkg-config HIDDEN
system=$PATH
echo "== without one"
HIDDEN=openssl/hmac.h run
echo "== without several, and programs"
HIDDEN="Python.h pybind11/pybind11.h eigen3"
without msgfmt objcopy
run
PATH=$system
echo "== without pkg-config"
without pkg-config pkgconf
HIDDEN= PKG_CONFIG= run
PATH=$system
echo "== an old compiler"
HIDDEN=optional run
echo "== another Python"
HIDDEN= run --with-python=/nowhere/python3
echo "== libraries that are not needed"
HIDDEN="libmodbus libusb-1.0 gl tcl readline/readline.h" run
ls "$work/build/Makefile.inc" > /dev/null && echo made
