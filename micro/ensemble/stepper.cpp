#include "micro/ensemble/stepper.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// The list reaches further than the cutoff by this share of it: a compromise between long lists
// and frequent rebuilds, without influence on the results.
constexpr double skin_over_cutoff = 0.45;

// Cells that left the box are moved back, and segments are looked at, every so many steps. Counted
// from step 0, so that a restart does the same.
constexpr std::int64_t steps_between_homecomings = 64;
constexpr std::int64_t steps_between_looks = 16;

Vector<2> centre(const EnsembleState& state, std::size_t cell) {
  Vector<2> sum = Vector<2>::Zero();
  for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
    sum += Vector<2>(state.x[i], state.y[i]);
  }
  return sum / static_cast<double>(state.nodes);
}

/// Sum and largest of the squared forces. Eight partial results in fixed order: the same bits at
/// any vector width. The sum is not finite if any force is not.
void sum_squares(const double* force_x, const double* force_y, std::size_t n, double& sum,
                 double& largest) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  double maxima[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const double square = force_x[i + k] * force_x[i + k] + force_y[i + k] * force_y[i + k];
      sums[k] += square;
      maxima[k] = square > maxima[k] ? square : maxima[k];
    }
  }
  for (; i < n; ++i) {
    const double square = force_x[i] * force_x[i] + force_y[i] * force_y[i];
    sums[0] += square;
    maxima[0] = square > maxima[0] ? square : maxima[0];
  }
  sum = ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  largest = *std::max_element(maxima, maxima + lanes);
}

}  // namespace

Stepper::Stepper(const EnsembleSystem& system) : system_(system) {
  list_skin_ = skin_over_cutoff * std::sqrt(system_.contact.cutoff_squared);
  scratch_.assign(static_cast<std::size_t>(system_.threads), RingGeometry(system_.mesh.nodes));
}

void Stepper::update_list(const EnsembleState& state, const Box& box) {
  // Let every node move by at most `travel` relative to a flow of gradient g since the list was
  // built. Two nodes that are now closer than rc were then closer than exp(strain) (rc + 2 travel),
  // by Gronwall's inequality run backwards; these pairs are in the list if its range covers that.
  const double cutoff = std::sqrt(system_.contact.cutoff_squared);
  const double range = cutoff + list_skin_;
  if (list_is_valid_ && std::exp(list_strain_) * (cutoff + 2 * list_travel_) <= range) {
    return;
  }
  list_.build(state, box, range);
  list_is_valid_ = true;
  list_travel_ = 0;
  list_strain_ = 0;
}

void Stepper::forces_on_cell(std::size_t cell, const EnsembleState& state, const Box& box,
                             const ImageTable& images, RingGeometry& scratch, bool sampled) {
  const std::size_t first = cell * state.nodes;
  const std::size_t last = first + state.nodes;
  double* const force_x = force_x_.data();
  double* const force_y = force_y_.data();
  ring_forces(system_.laws, system_.mesh, state.x.data() + first, state.y.data() + first, scratch,
              force_x + first, force_y + first);
  CellSums& sums = cell_sums_[cell];
  if (state.step % steps_between_looks == 0) {
    sums.largest_stretch = 0;
    sums.smallest_stretch = 1;
    for (std::size_t j = 0; j < state.nodes; ++j) {
      const double stretch = 1 / (scratch.inverse_length[j + 1] * system_.mesh.rest_length[j]);
      sums.largest_stretch = std::max(sums.largest_stretch, stretch);
      sums.smallest_stretch = std::min(sums.smallest_stretch, stretch);
    }
  }
  if (sampled) {
    const Vector<2> middle = centre(state, cell);
    sums.membrane_virial.setZero();
    for (std::size_t i = first; i < last; ++i) {
      sums.membrane_virial += Vector<2>(force_x[i], force_y[i]) *
                              (Vector<2>(state.x[i], state.y[i]) - middle).transpose();
    }
    sums.contact_virial = sum_pairs(state, list_, images, system_.contact, first, last).virial;
  }
  add_pair_forces(state, list_, images, system_.contact, first, last, force_x, force_y);
  if (box.walls) {
    for (std::size_t i = first; i < last; ++i) {
      force_y[i] += system_.wall.force(state.y[i]) - system_.wall.force(box.height - state.y[i]);
    }
  }
  sum_squares(force_x + first, force_y + first, state.nodes, sums.squared_forces,
              sums.largest_squared_force);
}

void Stepper::move_cell(std::size_t cell, EnsembleState& state, const Flow& flow) const {
  const std::size_t n = state.nodes;
  double* const x = state.x.data() + cell * n;
  double* const y = state.y.data() + cell * n;
  const double* const force_x = force_x_.data() + cell * n;
  const double* const force_y = force_y_.data() + cell * n;
  const double dt = system_.time_step;
  const double step_over_drag = dt / system_.node_drag;
  if (const auto* shear = std::get_if<SimpleShear>(&flow)) {
    const double strain = shear->rate * dt;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += strain * y[i] + step_over_drag * force_x[i];
      y[i] += step_over_drag * force_y[i];
    }
  } else {
    const CubicProfile& profile = std::get<CubicProfile>(flow);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += dt * profile(y[i]) + step_over_drag * force_x[i];
      y[i] += step_over_drag * force_y[i];
    }
  }
}

void Stepper::watch(const EnsembleState& state) const {
  const double limit = system_.segment_strain_limit;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const CellSums& sums = cell_sums_[cell];
    if (!std::isfinite(sums.squared_forces)) {
      for (std::size_t k = 0; k < state.nodes; ++k) {
        const std::size_t i = cell * state.nodes + k;
        if (!std::isfinite(force_x_[i] * force_x_[i] + force_y_[i] * force_y_[i])) {
          throw NumericalError(
              fmt::format("step {}, time {:.6g} s: the force on node {} of cell {} is ({:.6g}, "
                          "{:.6g}) N/m; it must be "
                          "finite; the time step is {:.4g} s and its explicit limit {:.4g} s: "
                          "reduce the time step, or "
                          "stiffen membrane and contact if it is below the limit",
                          state.step, state.time, k, cell, force_x_[i], force_y_[i],
                          system_.time_step, system_.explicit_limit));
        }
      }
    }
    const double strain = std::max(sums.largest_stretch - 1, 1 / sums.smallest_stretch - 1);
    if (!(strain <= limit)) {
      std::size_t worst = 0;
      double largest = 0;
      for (std::size_t k = 0; k < state.nodes; ++k) {
        const std::size_t i = cell * state.nodes + k;
        const std::size_t j = cell * state.nodes + (k + 1) % state.nodes;
        const double stretch = std::hypot(state.x[j] - state.x[i], state.y[j] - state.y[i]) /
                               system_.mesh.rest_length[k];
        const double own = std::max(stretch, 1 / stretch) - 1;
        if (!(own <= largest)) {
          largest = own;
          worst = k;
        }
      }
      throw NumericalError(
          fmt::format("step {}, time {:.6g} s: the segment after node {} of cell {} is stretched "
                      "or compressed by a "
                      "factor {:.4g}; at most {:.4g} is admitted; the time step is {:.4g} s and "
                      "its explicit limit "
                      "{:.4g} s: {}",
                      state.step, state.time, worst, cell, 1 + strain, 1 + limit, system_.time_step,
                      system_.explicit_limit,
                      system_.time_step > system_.explicit_limit
                          ? "reduce the time step below the limit"
                          : "raise the stretch modulus or lower the shear rate"));
    }
  }
}

bool Stepper::bring_home(EnsembleState& state, const Box& box) const {
  bool moved = false;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const Vector<2> middle = centre(state, cell);
    const double row = box.walls ? 0 : std::floor(middle.y() / box.height);
    const double column = std::floor((middle.x() - row * state.image_offset) / box.length);
    if (row == 0 && column == 0) {
      continue;
    }
    moved = true;
    const double dx = column * box.length + row * state.image_offset;
    const double dy = row * box.height;
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      state.x[i] -= dx;
      state.y[i] -= dy;
    }
  }
  return moved;
}

void Stepper::add_sums(const EnsembleState& state, const Box& box, StepSums& sums) const {
  sums = StepSums{};
  double squares = 0;
  for (const CellSums& cell : cell_sums_) {
    sums.membrane_virial += cell.membrane_virial;
    sums.contact_virial += cell.contact_virial;
    squares += cell.squared_forces;
  }
  sums.dissipation = squares / system_.node_drag;
  if (box.walls) {
    for (const double y : state.y) {
      sums.lower_wall += system_.wall.force(y);
      sums.upper_wall += system_.wall.force(box.height - y);
    }
  }
}

void Stepper::step(EnsembleState& state, const Box& box, const Flow& flow, StepSums* sums) {
  force_x_.resize(state.x.size());
  force_y_.resize(state.x.size());
  cell_sums_.resize(state.cells);
  update_list(state, box);
  const ImageTable images(box, state.image_offset);
  const bool sampled = sums != nullptr;
  const auto cells = static_cast<std::ptrdiff_t>(state.cells);
  if (system_.threads == 1) {
    for (std::size_t cell = 0; cell < state.cells; ++cell) {
      forces_on_cell(cell, state, box, images, scratch_.front(), sampled);
    }
  } else {
#pragma omp parallel for schedule(static) num_threads(system_.threads)
    for (std::ptrdiff_t cell = 0; cell < cells; ++cell) {
      forces_on_cell(static_cast<std::size_t>(cell), state, box, images,
                     scratch_[static_cast<std::size_t>(omp_get_thread_num())], sampled);
    }
  }
  watch(state);
  if (sums != nullptr) {
    add_sums(state, box, *sums);
  }
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    move_cell(cell, state, flow);
  }
  double largest = 0;
  for (const CellSums& cell : cell_sums_) {
    largest = std::max(largest, cell.largest_squared_force);
  }
  const double dt = system_.time_step;
  double rate = 0;  // [1/s] largest of the flow
  if (const auto* shear = std::get_if<SimpleShear>(&flow)) {
    rate = std::abs(shear->rate);
    state.image_offset += shear->rate * dt * box.height;
    if (state.image_offset < 0 || state.image_offset >= box.length) {
      state.image_offset -= std::floor(state.image_offset / box.length) * box.length;
      list_is_valid_ = false;  // the columns of its images are counted anew
    }
  } else {
    rate = std::get<CubicProfile>(flow).largest_shear_rate();
  }
  list_travel_ += dt * std::sqrt(largest) / system_.node_drag;
  list_strain_ += rate * dt;
  state.strain += rate * dt;
  state.time += dt;
  ++state.step;
  if (state.step % steps_between_homecomings == 0 && bring_home(state, box)) {
    list_is_valid_ = false;
  }
}

double Stepper::energy(const EnsembleState& state, const Box& box) {
  update_list(state, box);
  const ImageTable images(box, state.image_offset);
  double sum = 0;
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const std::size_t first = cell * state.nodes;
    sum += ring_energy(system_.laws, system_.mesh, state.x.data() + first, state.y.data() + first,
                       scratch_.front());
    sum += sum_pairs(state, list_, images, system_.contact, first, first + state.nodes).energy;
  }
  if (box.walls) {
    for (const double y : state.y) {
      sum += system_.wall.energy(y) + system_.wall.energy(box.height - y);
    }
  }
  return sum;
}

}  // namespace hemoscale::micro
