#!/bin/bash
exec ../lib/run.sh
