#include "macro/openfoam/point_locator.hpp"

#include "PstreamCombineReduceOps.H"
#include "fvMesh.H"

namespace hemoscale::macro {
namespace {

Foam::labelList lowest_rank_with(const Foam::labelList& cells) {
  Foam::labelList ranks(cells.size(), Foam::labelMax);
  forAll(cells, i) {
    if (cells[i] >= 0) ranks[i] = Foam::Pstream::myProcNo();
  }
  Foam::Pstream::listCombineGather(ranks, Foam::minEqOp<Foam::label>());
  Foam::Pstream::listCombineScatter(ranks);
  forAll(ranks, i) {
    if (ranks[i] == Foam::labelMax) ranks[i] = -1;
  }
  return ranks;
}

}  // namespace

PointLocator::PointLocator(const Foam::fvMesh& mesh) : search_(mesh, Foam::polyMesh::CELL_TETS) {}

Foam::label PointLocator::cell_at_boundary(const Foam::point& x) const {
  const Foam::label cell = search_.findNearestCell(x);
  if (cell < 0) return -1;
  const Foam::point inwards = x + 1e-8 * (search_.mesh().cellCentres()[cell] - x);
  return search_.mesh().pointInCell(inwards, cell, search_.decompMode()) ? cell : -1;
}

PointLocator::Places PointLocator::locate(const Foam::pointField& points) const {
  Places places;
  places.cells.setSize(points.size(), -1);
  // A rank may own no cells at all; the search tree of an empty mesh cannot be asked.
  const bool has_cells = search_.mesh().nCells() > 0;
  for (Foam::label i = 0; has_cells && i < points.size(); ++i) {
    places.cells[i] = search_.findCell(points[i]);
  }
  places.owners = lowest_rank_with(places.cells);
  for (Foam::label i = 0; has_cells && i < points.size(); ++i) {
    if (places.owners[i] < 0) places.cells[i] = cell_at_boundary(points[i]);
  }
  places.owners = lowest_rank_with(places.cells);
  for (Foam::label i = 0; i < points.size(); ++i) {
    if (places.owners[i] != Foam::Pstream::myProcNo()) places.cells[i] = -1;
  }
  return places;
}

}  // namespace hemoscale::macro
