"""Checks an XDMF file and what it refers to: well-formed, every data set present with the stated
size and type, rings closed, views equal to the frames of the trajectory."""

import os
import sys
import xml.etree.ElementTree

import h5py
import numpy

path = sys.argv[1]
root = xml.etree.ElementTree.parse(path).getroot()
assert root.tag == "Xdmf" and root.get("Version") == "3.0"
collection = root.find("Domain/Grid")
assert collection.get("GridType") == "Collection"
assert collection.get("CollectionType") == "Temporal"
grids = collection.findall("Grid")
assert len(grids) == 3, len(grids)


def values(item):
    """The array a DataItem stands for."""
    shape = tuple(int(size) for size in item.get("Dimensions").split())
    if item.get("Format") == "XML":
        result = numpy.array([float(word) for word in item.text.split()])
        assert result.shape == shape
        return result
    file, name = item.text.split(":")
    assert os.path.basename(file) == file, "not relative to the XDMF file"
    with h5py.File(os.path.join(os.path.dirname(path), file), "r") as data:
        result = data[name][...]
    assert result.shape == shape, (name, result.shape, shape)
    assert result.dtype.itemsize == int(item.get("Precision"))
    assert result.dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")]
    return result


trajectory = h5py.File(os.path.splitext(path)[0] + ".h5", "r")
(particles,) = trajectory["particles"].values()
cells = particles["cell"][...]
free = numpy.count_nonzero(cells < 0)
for number, grid in enumerate(grids):
    assert float(grid.find("Time").get("Value")) == particles["position/time"][number]
    topology = grid.find("Topology")
    elements = values(topology.find("DataItem"))
    assert elements.shape == (
        int(topology.get("NumberOfElements")),
        int(topology.get("NodesPerElement")),
    )
    has_rings = cells.max() >= 0
    assert topology.get("TopologyType") == ("Polyline" if has_rings else "Polyvertex")
    assert len(elements) == cells.max() + 1 + free
    assert sorted(set(elements.ravel())) == list(range(len(cells)))  # every particle, no other
    for element in elements:
        assert element[0] == element[-1], "not closed"
        assert len(set(cells[element])) == 1, "two rings in one line"
        if cells[element[0]] >= 0:
            assert set(element) == set(numpy.flatnonzero(cells == cells[element[0]]))
    geometry = grid.find("Geometry")
    positions = values(geometry.find("DataItem"))
    assert geometry.get("GeometryType") == {2: "XY", 3: "XYZ"}[positions.shape[1]]
    assert numpy.array_equal(positions, particles["position/value"][number])
    attributes = {item.get("Name"): item for item in grid.findall("Attribute")}
    assert numpy.array_equal(values(attributes["cell"].find("DataItem")), cells)
    assert ("velocity" in attributes) == ("velocity" in particles)
    if "velocity" in particles:
        velocities = values(attributes["velocity"].find("DataItem"))
        assert numpy.array_equal(velocities, particles["velocity/value"][number])
    for name, observable in trajectory["observables"].items():
        if name != "box_offset":
            (value,) = values(attributes[name].find("DataItem"))
            assert value == observable["value"][number]
