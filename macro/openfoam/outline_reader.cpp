#include "macro/openfoam/outline_reader.hpp"

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "emptyPolyPatch.H"
#include "macro/error.hpp"
#include "polyMesh.H"
#include "wallPolyPatch.H"

namespace hemoscale::macro {
namespace {

using Polyline = MeshOutline::Polyline;

/// Edges by the point at which they begin; each point has one that begins there.
using Edges = std::map<Foam::label, Foam::label>;

class Outline {
 public:
  Outline(const Foam::polyMesh& mesh, const MeshUnits& units)
      : mesh_(mesh), units_(units), back_(Foam::min(mesh.points().component(2))) {
    const Foam::scalar front = Foam::max(mesh.points().component(2));
    margin_ = 1e-6 * (front - back_);
    const bool is_plane =
        mesh.geometricD().z() < 0 && mesh.geometricD().x() > 0 && mesh.geometricD().y() > 0;
    if (!is_plane) {
      throw ParameterError(
          "outline of an OpenFOAM mesh: the mesh is not plane in x and y; make it one cell deep in "
          "z, with patches of type empty on both sides");
    }
  }

  void add_edges(const Foam::polyPatch& patch, Edges& edges) const {
    for (const Foam::face& face : static_cast<const Foam::faceList&>(patch)) {
      for (Foam::label k = 0; k < face.size(); ++k) {
        // Seen from outside a face is counter-clockwise: its edge of least z has the fluid on the
        // left.
        const Foam::label a = face[k];
        const Foam::label b = face.nextLabel(k);
        if (!is_at_back(a) || !is_at_back(b)) continue;
        if (!edges.emplace(a, b).second) {
          std::ostringstream message;
          message << "outline of an OpenFOAM mesh: boundaries touch at (" << place(a).transpose()
                  << ") m; separate them there";
          throw ParameterError(message.str());
        }
      }
    }
  }

  /// Open polylines first, from where no edge ends; then closed ones.
  std::vector<Polyline> joined(Edges edges) const {
    std::set<Foam::label> ends;
    for (const auto& edge : edges) ends.insert(edge.second);
    std::vector<Foam::label> begins;
    for (const auto& edge : edges) {
      if (ends.count(edge.first) == 0) begins.push_back(edge.first);
    }
    std::vector<Polyline> polylines;
    for (const Foam::label begin : begins) polylines.push_back(followed(begin, edges));
    while (!edges.empty()) polylines.push_back(followed(edges.begin()->first, edges));
    return polylines;
  }

 private:
  bool is_at_back(Foam::label point) const { return mesh_.points()[point].z() - back_ < margin_; }
  Vector<2> place(Foam::label point) const {
    const Foam::point& x = mesh_.points()[point];
    return Vector<2>(x.x(), x.y()) * units_.length;
  }

  /// The polyline from a point on; its edges are taken out.
  Polyline followed(Foam::label begin, Edges& edges) const {
    Polyline polyline = {place(begin)};
    for (auto edge = edges.find(begin); edge != edges.end();) {
      const Foam::label end = edge->second;
      edges.erase(edge);
      add_point(polyline, place(end));
      edge = edges.find(end);
    }
    return polyline;
  }

  /// Replaces the last point if it lies on the way to the next one.
  static void add_point(Polyline& polyline, const Vector<2>& next) {
    if (polyline.size() > 1) {
      const Vector<2> before = (polyline.back() - polyline[polyline.size() - 2]).normalized();
      const Vector<2> after = (next - polyline.back()).normalized();
      const double turn = before(0) * after(1) - before(1) * after(0);
      if (std::abs(turn) < 1e-7 && before.dot(after) > 0) polyline.pop_back();
    }
    polyline.push_back(next);
  }

  const Foam::polyMesh& mesh_;
  const MeshUnits& units_;
  Foam::scalar back_;        // [mesh length]
  Foam::scalar margin_ = 0;  // [mesh length]
};

}  // namespace

MeshOutline wall_polylines(const Foam::polyMesh& mesh, const MeshUnits& units) {
  const Outline outline(mesh, units);
  MeshOutline result;
  result.back = Foam::min(mesh.points().component(2)) * units.length;
  result.front = Foam::max(mesh.points().component(2)) * units.length;
  Edges of_walls;
  for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
    if (Foam::isA<Foam::emptyPolyPatch>(patch)) continue;
    if (Foam::isA<Foam::wallPolyPatch>(patch)) {
      outline.add_edges(patch, of_walls);
      continue;
    }
    Edges edges;
    outline.add_edges(patch, edges);
    result.openings.push_back({patch.name(), outline.joined(edges)});
  }
  result.walls = outline.joined(of_walls);
  return result;
}

}  // namespace hemoscale::macro
