"""A small plasma case that tests change."""

PLASMA = """
[case]
name = "plasma"
[scene]
kind = "micro"
[fluid]
plasma_viscosity = "1 mPa s"
density = "1000 kg/m^3"
[micro]
model = "plasma"
duration = "20 us"
output_interval = "10 us"
[micro.plasma]
flow = "periodic-channel"
length = "20 um"
height = "10 um"
spacing = "1 um"
speed = "10 mm/s"
[output]
trajectory = false
"""
