#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hemoscale::micro {

/// The domain: periodic along x; along y either walls at 0 and height, or images that slide.
struct Box {
  double length = 0;   // [m]
  double height = 0;   // [m]
  bool walls = false;  // at y = 0 and y = height

  double area() const { return length * height; }  // [m^2]
};

/// Number of an image: columns -4..4 and rows -2..2 around the box, packed for the neighbour list.
/// Whole cells leave the box by less than one length and height before they are moved back, so that
/// more images are never met.
struct Image {
  static constexpr int columns = 4;
  static constexpr int rows = 2;
  static constexpr std::size_t count = (2 * columns + 1) * (2 * rows + 1);

  static std::int32_t pack(int column, int row) {
    return static_cast<std::int32_t>((column + columns) * (2 * rows + 1) + row + rows);
  }
  static bool is_known(int column, int row) {
    return column >= -columns && column <= columns && row >= -rows && row <= rows;
  }
};

/// Displacement of every image at one moment: image (c, r) lies at (c length + r offset, r height).
struct ImageTable {
  ImageTable(const Box& box, double image_offset);

  std::array<double, Image::count> x = {};  // [m]
  std::array<double, Image::count> y = {};  // [m]
};

}  // namespace hemoscale::micro
