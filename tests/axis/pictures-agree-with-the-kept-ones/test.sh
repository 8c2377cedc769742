#!/bin/bash
# Scenes of the preview (scenes.py), drawn off screen by OSMesa, beside pictures that are kept and beside those drawn
# without OpenGL: within a tolerance, as drivers draw lines a little differently, and which still tells wrong ones.
# `pictures.py write` makes the kept ones anew: look at them then.
/usr/bin/python3 "$TEST_DIR/pictures.py" 2>errors || cat errors
rm -f errors
