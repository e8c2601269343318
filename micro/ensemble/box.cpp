#include "micro/ensemble/box.hpp"

namespace hemoscale::micro {

ImageTable::ImageTable(const Box& box, double image_offset) {
  for (int column = -Image::columns; column <= Image::columns; ++column) {
    for (int row = -Image::rows; row <= Image::rows; ++row) {
      const auto i = static_cast<std::size_t>(Image::pack(column, row));
      x[i] = column * box.length + row * image_offset;
      y[i] = row * box.height;
    }
  }
}

}  // namespace hemoscale::micro
