# SPDX-License-Identifier: GPL-2.0-or-later
# Sourced by tests that bring realtime modules of their own: module_tree FILE.c... makes
# ./tree, a place for a realtime host that finds all modules of this build and the given
# ones, compiled against the public headers as anybody would.
module_tree() {
    rm -rf tree && mkdir -p tree/bin tree/rtlib
    cp "$EMC2_HOME/bin/rtapi_app" tree/bin/
    ln -s "$EMC2_HOME"/rtlib/*.so tree/rtlib/
    ln -s "$EMC2_HOME/lib" tree/lib
    for source in "$@"; do
        ${CC:-gcc} -std=gnu11 -O2 -g -Wall -Wextra -Werror -DRTAPI -D_GNU_SOURCE -DUSPACE -Drealtime -DSIM \
            -D__MODULE__ -fPIC -fno-builtin-sin -fno-builtin-cos -fno-builtin-sincos \
            -I"$EMC2_HOME/include" -shared -Wl,-Bsymbolic -o "tree/rtlib/$(basename "$source" .c).so" "$source" -lm || exit 1
    done
    trap 'tree/bin/rtapi_app stop-and-clean 2>/dev/null; rm -rf tree' EXIT
}
