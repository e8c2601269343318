"""Files of trajectories, as HDF5 leaves them."""


def open_trajectory(path):
    import h5py

    try:
        return h5py.File(path, "r")
    except OSError:
        # A program that was killed while it wrote has left its mark; its frames are whole.
        return h5py.File(path, "r", swmr=True)
