#!/bin/bash
exec ../lib/run-machines
