#!/bin/bash
# FP-192: what dh_python3 makes of our debian/ and the modules of this build, and the check that debian/rules makes before a
# package is released: modules for another Python, ones that do not load, packages that depend on no range.
top=$EMC2_HOME
[ -f "$top/debian/control" ] || { echo "no debian/ in $top"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$top/debian" "$work"
cd "$work" || exit
rm -rf debian/kerf debian/kerf-dev
eval "$(dpkg-architecture -s)"
export DEB_HOST_ARCH DEB_HOST_MULTIARCH
modules=debian/kerf/usr/lib/python3/dist-packages
mkdir -p $modules debian/kerf-dev/usr/lib/python3/dist-packages
cp "$top"/lib/python/*.so $modules
cp "$top"/lib/*.so.* debian/kerf/usr/lib
echo "pass" > $modules/pure.py
echo "pass" > debian/kerf-dev/usr/lib/python3/dist-packages/pure.py
dh_python3 -pkerf -pkerf-dev
version=$(/usr/bin/python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
next=$(/usr/bin/python3 -c 'import sys; print("3.%d" % (sys.version_info[1] + 1))')
plain() { sed "s/$next/NEXT/g; s/$version/THIS/g; s/cpython-3[0-9]*-[a-z0-9_-]*/TAG/; s|OSError: .*/|OSError: |; s/cpython-3[0-9]*-[a-z0-9_-]*/TAG/"; }
depends() { for p in "$@"; do dpkg-gencontrol -p"$p" -O -Pdebian/"$p" -Tdebian/"$p".substvars 2>/dev/null; done |
    sed -n '/^Package/p; s/^Depends:.*\(python3 (<<[^)]*), python3 ([^)]*)\).*/Depends: \1/p' | plain; }
check() { debian/check-python-abi kerf kerf-dev 2>&1 | plain; echo "status ${PIPESTATUS[0]}"; }
mkdir -p debian/kerf/DEBIAN debian/kerf-dev/DEBIAN
depends kerf kerf-dev
echo "== this build"
check
echo "== names of one Python version in debian/:"
grep -nE 'python3\.[0-9]' debian/control debian/*.install debian/rules
echo "== modules for another Python, and one that does not load"
echo 'int x;' | gcc -shared -fPIC -x c -o $modules/old.cpython-39-x86_64-linux-gnu.so -
suffix=$(/usr/bin/python3 -c 'import sysconfig; print(sysconfig.get_config_var("EXT_SUFFIX"))')
echo 'extern int PyOfAnotherVersion(void); int PyInit_new(void) { return PyOfAnotherVersion(); }' |
    gcc -shared -fPIC -x c -o "$modules/new$suffix" -
check
rm $modules/old.* $modules/new.*
echo "== a package without the range"
echo "python3:Depends=python3:any" > debian/kerf.substvars
check
