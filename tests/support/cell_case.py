"""A small case of cells in plasma that tests change."""

CELLS = """
[case]
name = "cells"
[scene]
kind = "micro"
[fluid]
plasma_viscosity = "1 mPa s"
density = "1000 kg/m^3"
[micro]
model = "plasma"
duration = "0.4 ms"
output_interval = "0.1 ms"
[micro.plasma]
flow = "open-channel"
length = "40 um"
height = "10 um"
spacing = "1 um"
speed = "10 mm/s"
membranes = "implicit"
[micro.cell]
nodes = 40
x = "15 um"
"""

SHEAR = """
[case]
name = "shear"
[scene]
kind = "micro"
[fluid]
plasma_viscosity = "1 mPa s"
[micro]
model = "plasma"
duration = "0.1 s"
output_interval = "10 ms"
[micro.plasma]
flow = "unbounded-shear"
rate = "100 1/s"
membranes = "implicit"
[micro.cell]
nodes = 40
angle = "0 degree"
reduced_area = 0.7
"""
