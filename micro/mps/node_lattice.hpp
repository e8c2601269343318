#pragma once

#include "micro/mps/node_domains.hpp"

namespace hemoscale::micro {

/// Least distance of inner nodes from curved boundaries over the spacing.
inline constexpr double clearance = 0.6;

/// @throws ParameterError for a spacing that is not positive, or a disorder outside [0, 0.5)
void check(const NodeSpacing& spacing);

/// Appends nodes to a domain, numbering them and displacing the inner ones at random.
template <int dim>
class NodeWriter {
 public:
  NodeWriter(FlowDomain<dim>& domain, const NodeSpacing& spacing)
      : domain_(&domain),
        spacing_(spacing),
        next_identity_(static_cast<std::int64_t>(domain.particles.size())) {}

  void inner(const Vector<dim>& x);
  void boundary(const Vector<dim>& x, std::int32_t patch, const Vector<dim>& normal,
                double measure);

 private:
  FlowDomain<dim>* domain_;
  NodeSpacing spacing_;
  std::int64_t next_identity_;
};

/// The domain less its inner nodes in the hole or within the clearance of it, plus nodes on the
/// hole.
FlowDomain<2> with_hole(const FlowDomain<2>& domain, const OutlineLoop& hole,
                        std::vector<Patch<2>> patches, const NodeSpacing& spacing);

}  // namespace hemoscale::micro
