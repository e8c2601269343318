#pragma once

#include <span>

namespace hemoscale::micro {

// Vector operations of iterative methods; shared among threads element by element, so that any
// number of them gives the same bits.

/// y <- y + factor x
void add(double factor, std::span<const double> x, std::span<double> y);

/// y <- x + factor y
void combine(std::span<const double> x, double factor, std::span<double> y);

/// y <- factor y
void scale(double factor, std::span<double> y);

/// y <- a - b
void subtract(std::span<const double> a, std::span<const double> b, std::span<double> y);

}  // namespace hemoscale::micro
