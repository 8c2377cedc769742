#!/bin/sh
echo $$ > ../tab
exec sleep 1000
