"""Four cells in a small shear box: a run of a second or less that tests change."""

SMALL = """[case]
name = "small"
[scene]
kind = "micro"
[fluid]
hematocrit = 0.2
[micro]
cells = 4
nodes = 24
shear_rate = "100 1/s"
duration = "16 ms"
output_interval = "8 ms"
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
[output]
trajectory = false
"""
