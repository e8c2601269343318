#pragma once

#include <memory>

#include "labelList.H"
#include "meshSearch.H"
#include "pointField.H"

namespace Foam {
class fvMesh;
}

namespace hemoscale::macro {

/// Finds the cells of points in a mesh that may be spread over ranks. Valid as long as the mesh
/// neither moves nor changes. Building it and every call are collective.
class PointLocator {
 public:
  explicit PointLocator(const Foam::fvMesh& mesh);

  struct Places {
    Foam::labelList cells;   // cell of the point on this rank, or -1
    Foam::labelList owners;  // rank that has the point, the same on all ranks; -1 outside the mesh
  };

  /// A point on a face between two ranks has exactly one owner, the lower rank. A point on the
  /// boundary of the mesh is inside, whichever way it was rounded: one that is outside by less than
  /// 1e-8 of its distance to the nearest cell centre belongs to that cell.
  ///
  /// @param points  the same on all ranks [mesh length]
  Places locate(const Foam::pointField& points) const;

 private:
  Foam::label cell_at_boundary(const Foam::point& x) const;

  Foam::meshSearch search_;
};

}  // namespace hemoscale::macro
