#!/bin/bash
# fp-032 fp-033 fp-034 fp-037 fp-038 fp-040 fp-042 fp-043 fp-044 fp-046 fp-047, one case each.
exec "$EMC2_HOME"/objects/test/tp-quality
