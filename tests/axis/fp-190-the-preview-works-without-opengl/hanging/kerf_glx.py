# Stands for a driver that hangs.
import time

time.sleep(1000)
