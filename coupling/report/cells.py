"""Pictures of cells in plasma: outlines over time, and the flow around them."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize

from cell_tables import MICRO, centroid, closed, read_frames, read_grid
from picture import BLUE, GREEN, GREY, RED, label, scaled

WALL = "#404040"


def part_of(name, low, high):
    """A part of a map of colours."""
    return LinearSegmentedColormap.from_list(name, plt.get_cmap(name)(np.linspace(low, high)))


# Maps whose lightness is monotonous, so that neither colour-blind readers nor a black-and-white
# print lose the order. Of each the part that can be told from the lines drawn over it.
TIME_COLOURS = part_of("viridis", 0, 0.88)
PRESSURE_COLOURS = part_of("cividis", 0.35, 1)
SPEED_COLOURS = part_of("Blues", 0.02, 0.65)
LINE = "#303030"
WIDTH = 9.0  # inches, of a figure
SPARE = 1.7  # inches of the width that axes leave to labels and a colour bar


def draw_walls(axis, folder):
    table = folder.table("walls.csv")
    if table is None or len(table) == 0:
        return
    for piece in np.unique(table["piece"]):
        chosen = table["piece"] == piece
        axis.plot(MICRO * table["x"][chosen], MICRO * table["y"][chosen], color=WALL, linewidth=2.5)


def plain_axis(axis):
    """Equal scales without a grid, in micrometres."""
    axis.set_aspect("equal")
    axis.grid(False)
    for side in axis.spines.values():
        side.set_visible(True)
    axis.set_xlabel("x [µm]")
    axis.set_ylabel("y [µm]")


def colour_bar(axis, colours, text):
    """A bar as high as the axis, whatever its aspect."""
    place = axis.inset_axes([1.015, 0, 0.03 if axis.get_position().width < 0.5 else 0.015, 1])
    bar = axis.figure.colorbar(colours, cax=place)
    bar.set_label(text, fontsize=9)
    bar.ax.tick_params(labelsize=8)
    bar.locator = plt.MaxNLocator(nbins=5)
    bar.update_ticks()
    bar.outline.set_visible(False)


def domain(folder, points):
    """Extent of walls and cells [µm]."""
    table = folder.table("walls.csv")
    if table is not None and len(table):
        points = np.vstack([points, MICRO * np.column_stack([table["x"], table["y"]])])
    return points.min(axis=0), points.max(axis=0)


def height_for(low, high, width):
    """Height of an equal-aspect axis [inch] with its labels."""
    return width * (high[1] - low[1]) / (high[0] - low[0]) + 0.75


def draw_journey(axis, folder, frames, low, high):
    draw_walls(axis, folder)
    factor, unit = scaled(frames.times[-1:], "s")
    chosen = frames.apart()
    norm = Normalize(factor * frames.times[0], factor * frames.times[-1])
    for frame in chosen:
        colour = TIME_COLOURS(norm(factor * frames.times[frame]))
        for ring in frames.rings[frame]:
            axis.fill(*ring.T, facecolor=(*colour[:3], 0.18), edgecolor=colour, linewidth=1.4)
    plain_axis(axis)
    margin = 0.02 * (high[1] - low[1])
    axis.set_xlim(low[0] - margin, high[0] + margin)
    axis.set_ylim(low[1] - margin, high[1] + margin)
    colour_bar(axis, plt.cm.ScalarMappable(norm, TIME_COLOURS), label("time", unit))


def draw_final_shape(axis, frames):
    """The first cell at the end and at the start, about its centroid."""
    start, end = frames.rings[0][0], frames.rings[-1][0]
    start, end = start - centroid(start), end - centroid(end)
    axis.plot(*closed(start).T, "--", color=GREY, linewidth=1.3, label="start")
    axis.fill(*end.T, facecolor=RED, alpha=0.15)
    axis.plot(*closed(end).T, color=RED, label="end")
    reach = 1.3 * max(np.abs(start).max(), np.abs(end).max())
    for sign, name, colour in ((-1, "rear", BLUE), (1, "front", GREEN)):
        # Where the outline crosses the line along the flow through the centroid.
        nodes = closed(end)
        below = nodes[:-1, 1] <= 0
        crossing = np.flatnonzero(below != (nodes[1:, 1] <= 0))
        share = nodes[crossing, 1] / (nodes[crossing, 1] - nodes[crossing + 1, 1])
        x = nodes[crossing, 0] + share * (nodes[crossing + 1, 0] - nodes[crossing, 0])
        outermost = sign * (sign * x).max()
        axis.plot(outermost, 0, "o", color=colour, markersize=6, zorder=3)
        axis.annotate(
            name,
            (outermost, 0),
            (sign * reach * 0.97, 0.16 * reach),
            color=colour,
            ha="left" if sign < 0 else "right",
            fontsize=9,
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.8, "shrinkB": 4},
        )
    plain_axis(axis)
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-reach, 1.25 * reach)
    axis.set_xlabel("x from the centroid [µm]")
    axis.set_ylabel("y from the centroid [µm]")
    axis.legend(loc="upper left", fontsize=9, ncol=2, borderaxespad=0.2)
    axis.set_title(cell_title(frames, "shape"), fontsize=10)


def draw_turning_shape(axis, frames):
    """The first cell at some times, about its centroid."""
    factor, unit = scaled(frames.times[-1:], "s")
    chosen = np.unique(np.linspace(0, len(frames.times) - 1, 6).round().astype(int))
    norm = Normalize(factor * frames.times[0], factor * frames.times[-1])
    for frame in chosen:
        ring = frames.rings[frame][0]
        is_first = frame == 0
        axis.plot(
            *closed(ring - centroid(ring)).T,
            "--" if is_first else "-",
            color=TIME_COLOURS(norm(factor * frames.times[frame])),
            linewidth=2 if frame == chosen[-1] else 1.3,
        )
        # Node 0 shows how far the membrane has moved around.
        node = ring[0] - centroid(ring)
        axis.plot(*node, "o", markersize=5, color=TIME_COLOURS(norm(factor * frames.times[frame])))
    plain_axis(axis)
    reach = 0.58 * frames.size()
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-reach, reach)
    axis.set_xlabel("x from the centroid [µm]")
    axis.set_ylabel("y from the centroid [µm]")
    axis.set_title(cell_title(frames, "shape (start dashed), dots: node 0"), fontsize=10)
    colour_bar(axis, plt.cm.ScalarMappable(norm, TIME_COLOURS), label("time", unit))


def cell_title(frames, text):
    return text[:1].upper() + text[1:] if len(frames.cells) == 1 else f"Cell 0: {text}"


def draw_tension(axis, frames):
    ring, tension = frames.rings[-1][0], MICRO * frames.tensions[-1][0]
    points = closed(ring - centroid(ring))
    lines = np.stack([points[:-1], points[1:]], axis=1)
    # Of a segment: the mean of its ends.
    values = (tension + np.roll(tension, -1)) / 2
    largest = np.abs(values).max()
    collection = LineCollection(lines, cmap="cividis", linewidths=5, capstyle="round")
    collection.set_array(values)
    if values.min() >= 0:
        collection.set_clim(0, largest)
    axis.add_collection(collection)
    plain_axis(axis)
    reach = 1.3 * np.abs(points).max()
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-reach, reach)
    axis.set_xlabel("x from the centroid [µm]")
    axis.set_ylabel("y from the centroid [µm]")
    axis.set_title(cell_title(frames, "tension at the end"), fontsize=10)
    colour_bar(axis, collection, "Tension [µN/m]")


def draw_cell_shapes(folder):
    frames = read_frames(folder)
    if frames is None:
        return
    tension = frames.tensions[-1][0]
    has_tension = bool(np.isfinite(tension).all() and np.any(tension != 0))
    draw_first = draw_final_shape if frames.travels() else draw_turning_shape
    panels = [draw_first, draw_tension] if has_tension else [draw_first]
    top = 0.0
    if frames.travels():
        low, high = domain(folder, np.vstack([ring for rings in frames.rings for ring in rings]))
        top = height_for(low, high, WIDTH - SPARE)
    figure = plt.figure(figsize=(WIDTH if top or has_tension else 5.4, top + 4.4))
    rows = figure.add_gridspec(2 if top else 1, 1, height_ratios=[top, 4.0] if top else [1])
    if top:
        draw_journey(figure.add_subplot(rows[0]), folder, frames, low, high)
    lower = rows[1 if top else 0].subgridspec(1, len(panels), wspace=0.35)
    for number, draw in enumerate(panels):
        draw(figure.add_subplot(lower[number]), frames)
    folder.save(figure, "cell-shapes.png")


def cell_velocity(folder, frames):
    """Velocity of the first cell along the flow [m/s]: of the summary, or else of its nodes."""
    name = "cell 0: velocity along the flow"
    return folder.figures.get(name, frames.velocities[-1][0][:, 0].mean())


def draw_outlines(axis, frames, colour):
    for ring in frames.rings[-1]:
        axis.plot(*closed(ring).T, color=colour, linewidth=2, zorder=3)


def draw_pressure(axis, folder, grid, frames):
    pressure = grid.fields["p"]
    factor, unit = scaled(pressure.compressed(), "Pa")
    mesh = axis.pcolormesh(
        grid.x, grid.y, factor * pressure, shading="nearest", cmap=PRESSURE_COLOURS, rasterized=True
    )
    axis.contour(
        *(grid.x, grid.y, factor * pressure),
        levels=24,
        colors=LINE,
        linewidths=0.5,
        linestyles="solid",
        alpha=0.6,
    )
    draw_walls(axis, folder)
    draw_outlines(axis, frames, "black")
    plain_axis(axis)
    colour_bar(axis, mesh, label("pressure", unit))


def draw_streamlines(axis, folder, grid, frames):
    ring = frames.rings[-1][0]
    middle = centroid(ring)
    reach = 1.5 * frames.size()
    speed = cell_velocity(folder, frames)
    u, v = grid.fields["u"] - speed, grid.fields["v"]
    near = (grid.x >= middle[0] - reach) & (grid.x <= middle[0] + reach)
    level = (grid.y >= middle[1] - reach) & (grid.y <= middle[1] + reach)
    x, y, u, v = grid.x[near], grid.y[level], u[level][:, near], v[level][:, near]
    magnitude = np.ma.hypot(u, v)
    factor, unit = scaled(magnitude.compressed(), "m/s")
    mesh = axis.pcolormesh(
        x, y, factor * magnitude, shading="nearest", cmap=SPEED_COLOURS, rasterized=True
    )
    axis.streamplot(x, y, u, v, color=LINE, linewidth=0.8, density=1.2, arrowsize=0.8)
    draw_walls(axis, folder)
    draw_outlines(axis, frames, RED)
    plain_axis(axis)
    margin = 0.02 * (y[-1] - y[0])
    axis.set_xlim(x[0], x[-1])
    axis.set_ylim(y[0] - margin, y[-1] + margin)
    given, given_unit = scaled(np.array([speed]), "m/s")
    moving = abs(factor * speed) > 1e-6 * factor * magnitude.max()
    frame = f"moving with cell 0, {given * speed:.4g} {given_unit}" if moving else "at rest"
    axis.set_title(f"Streamlines in the frame {frame}", fontsize=10)
    colour_bar(axis, mesh, label("speed in that frame", unit))


def draw_cell_flow(folder):
    frames, grid = read_frames(folder), read_grid(folder)
    if frames is None or grid is None:
        return
    low, high = np.array([grid.x[0], grid.y[0]]), np.array([grid.x[-1], grid.y[-1]])
    is_wide = high[0] - low[0] > 2 * (high[1] - low[1])
    width = WIDTH - SPARE
    if is_wide:
        top = height_for(low, high, width)
        figure, axes = plt.subplots(
            2, 1, figsize=(WIDTH, top + 4.0), gridspec_kw={"height_ratios": [top, 4.0]}
        )
    else:
        figure, axes = plt.subplots(1, 2, figsize=(1.25 * WIDTH, 4.9))
    draw_pressure(axes[0], folder, grid, frames)
    axes[0].set_xlim(low[0], high[0])
    factor, unit = scaled(frames.times[-1:], "s")
    axes[0].set_title(f"Pressure, t = {factor * frames.times[-1]:.4g} {unit}", fontsize=10)
    draw_streamlines(axes[1], folder, grid, frames)
    folder.save(figure, "cell-flow.png")
