#!/bin/bash
# Random machines, programs and events; an independent checker differentiates every position,
# and every program must reach its end (fp-037).
# 1243: an exact stop after a tiny arc, whose end once lay one rounding beyond its last cell.
"$EMC2_HOME"/objects/test/tp-property -1 1243 | tail -n 1
exec "$EMC2_HOME"/objects/test/tp-property -n 40
