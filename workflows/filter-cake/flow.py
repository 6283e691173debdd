"""Prints a table of absorption (CSV): flow.py STRONG TURN WEAK, a strong flow that lays the cake down until TURN (s), then a weak one; g/m2/s."""
import sys

strong, turn, weak = map(float, sys.argv[1:])
print("time [s],absorption [g/m2/s],evaporation [g/m2/s]")
for time, flow in ((0, strong), (turn, strong), (turn, weak), (turn + 280, weak)):
    print(f"{time:g},{flow:g},0")
