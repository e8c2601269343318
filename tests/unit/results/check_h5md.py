"""Checks a trajectory against the H5MD 1.1 specification (de Buyl, Colberg and Hoefling 2014), as
far as it is used."""

import sys

import h5py


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


with h5py.File(sys.argv[1], "r") as file:
    h5md = file["h5md"]
    assert list(h5md.attrs["version"]) == [1, 1]
    assert text(h5md["author"].attrs["name"])
    assert text(h5md["creator"].attrs["name"]) and "version" in h5md["creator"].attrs
    assert text(h5md["modules/units"].attrs["system"]) == "SI"
    assert list(h5md["modules/units"].attrs["version"]) == [1, 0]

    ((name, particles),) = file["particles"].items()
    box = particles["box"]
    dimension = int(box.attrs["dimension"])
    assert len(box.attrs["boundary"]) == dimension
    assert all(text(kind) in ("none", "periodic") for kind in box.attrs["boundary"])
    assert box["edges"].shape == (dimension,) and text(box["edges"].attrs["unit"]) == "m"
    count = len(particles["species"])
    assert particles["species"].dtype.kind == "i" and particles["species"].ndim == 1
    assert particles["cell"].shape == (count,)
    units = {"position": "m", "velocity": "m s-1"}
    for element, unit in units.items():
        if element in particles:
            value = particles[element]["value"]
            assert value.shape == (4, count, dimension)
            assert value.maxshape == (None, count, dimension) and value.chunks is not None
            assert text(value.attrs["unit"]) == unit

    elements = [particles[element] for element in units if element in particles]
    elements += list(file["observables"].values())
    assert "box_offset" in file["observables"]
    for element in elements:
        assert element["value"].shape[0] == 4
        assert list(element["step"]) == [1, 2, 3, 4] and element["step"].dtype.kind == "i"
        assert len(element["time"]) == 4 and text(element["time"].attrs["unit"]) == "s"
        assert element["step"] == elements[0]["step"], "steps are not shared"

    bonds = file["connectivity/bonds"]
    assert bonds.ndim == 2 and bonds.shape[1] == 2
    assert file[bonds.attrs["particles_group"]] == particles
    assert len(bonds) == (particles["cell"][...] >= 0).sum()
