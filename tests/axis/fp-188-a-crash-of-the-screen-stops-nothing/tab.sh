#!/bin/sh
# A program that shows itself in a tab.
echo $$ >> ../tabs
exec sleep 1000
