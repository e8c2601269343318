#include "micro/snapshot/xdmf.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "micro/snapshot/durable_file.hpp"
#include "micro/snapshot/trajectory_format.hpp"

namespace hemoscale::micro {
namespace {

using hdf5::check;
using hdf5::File;
using hdf5::Handle;

/// Text as it may stand in XML.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += character;
    }
  }
  return result;
}

std::string view_name(std::int64_t frame, const std::string& quantity) {
  return fmt::format("/{}/{}", frame, quantity);
}

/// Makes in `views` a data set that shows one frame of a data set of the trajectory.
void make_view(const File& views, const std::string& name, const TrajectoryReader& reader,
               const std::string& source, std::int64_t frame) {
  const std::string action = "make the view " + name;
  const TrajectoryLayout& layout = reader.layout();
  const std::array<hsize_t, 3> all{static_cast<hsize_t>(reader.frame_count()),
                                   static_cast<hsize_t>(layout.particle_count()),
                                   static_cast<hsize_t>(layout.dimension)};
  const std::array<hsize_t, 3> start{static_cast<hsize_t>(frame), 0, 0};
  const std::array<hsize_t, 3> count{1, all[1], all[2]};
  const Handle from(check(H5Screate_simple(3, all.data(), nullptr), views.path(), action),
                    H5Sclose);
  check(
      H5Sselect_hyperslab(from.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
      views.path(), action);
  const Handle shown(check(H5Screate_simple(2, &all[1], nullptr), views.path(), action), H5Sclose);
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE), views.path(), action), H5Pclose);
  // The name alone: HDF5 looks for it in the folder of the file with the views.
  const std::string file = reader.path().filename().string();
  check(H5Pset_virtual(properties.id(), shown.id(), file.c_str(), source.c_str(), from.id()),
        views.path(), action);
  const hid_t real = layout.single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  const Handle view(check(H5Dcreate2(views.id(), name.c_str(), real, shown.id(), H5P_DEFAULT,
                                     properties.id(), H5P_DEFAULT),
                          views.path(), action),
                    H5Dclose);
}

/// Views of every frame. ParaView's readers select a part of a data set each in their own language,
/// and each ends the program when it reads that of another; a whole data set all of them read.
void write_views(const TrajectoryReader& reader, const std::filesystem::path& path) {
  const hdf5::Silence silence;
  const trajectory_format::Names names(reader.layout());
  PartFile part(path);
  File views = trajectory_format::make_file(part.path());
  for (std::int64_t k = 0; k < reader.frame_count(); ++k) {
    views.make_group(fmt::format("/{}", k));
    make_view(views, view_name(k, "position"), reader, names.positions, k);
    if (reader.layout().has_velocities) {
      make_view(views, view_name(k, "velocity"), reader, names.velocities, k);
    }
  }
  views.close();
  part.move_into_place();
}

std::string reference(const std::string& file, const std::string& set, const std::string& number,
                      const std::string& extent) {
  return fmt::format(R"(<DataItem Format="HDF" {} Dimensions="{}">{}:{}</DataItem>)", number,
                     extent, escaped(file), escaped(set));
}

/// The temporal collection of all frames.
std::string grids(const TrajectoryReader& reader, const std::string& views) {
  const TrajectoryLayout& layout = reader.layout();
  const trajectory_format::Names names(layout);
  const trajectory_format::Topology topology = trajectory_format::topology_of(layout);
  const std::string file = reader.path().filename().string();
  const std::string real =
      fmt::format(R"(NumberType="Float" Precision="{}")", layout.single_precision ? 4 : 8);
  const std::string integer = R"(NumberType="Int" Precision="8")";
  const std::string extent = fmt::format("{} {}", layout.particle_count(), layout.dimension);
  const std::string lines = fmt::format(
      R"(<Topology TopologyType="{}" NumberOfElements="{}" NodesPerElement="{}">{}</Topology>)",
      topology.nodes_per_element > 1 ? "Polyline" : "Polyvertex", topology.elements,
      topology.nodes_per_element,
      reference(file, trajectory_format::topology_name, integer,
                fmt::format("{} {}", topology.elements, topology.nodes_per_element)));
  const std::string cells =
      reference(file, names.group + "/cell", integer, std::to_string(layout.particle_count()));
  std::vector<std::vector<double>> observables;
  for (std::size_t n = 0; n < layout.observables.size(); ++n) {
    observables.push_back(reader.observable(n));
  }

  std::string text;
  const auto out = std::back_inserter(text);
  for (std::int64_t k = 0; k < reader.frame_count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    fmt::format_to(out, "   <Grid Name=\"{}\" GridType=\"Uniform\">\n    <Time Value=\"{}\"/>\n",
                   escaped(layout.particles), reader.times()[at]);
    fmt::format_to(out, "    {}\n", lines);
    fmt::format_to(out, "    <Geometry GeometryType=\"{}\">{}</Geometry>\n",
                   layout.dimension == 2 ? "XY" : "XYZ",
                   reference(views, view_name(k, "position"), real, extent));
    fmt::format_to(
        out,
        "    <Attribute Name=\"cell\" AttributeType=\"Scalar\" Center=\"Node\">{}</Attribute>\n",
        cells);
    if (layout.has_velocities) {
      fmt::format_to(out,
                     "    <Attribute Name=\"velocity\" AttributeType=\"Vector\" "
                     "Center=\"Node\">{}</Attribute>\n",
                     reference(views, view_name(k, "velocity"), real, extent));
    }
    for (std::size_t n = 0; n < observables.size(); ++n) {
      fmt::format_to(
          out,
          "    <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Grid\"><DataItem "
          "Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"1\">{}"
          "</DataItem></Attribute>\n",
          escaped(layout.observables[n].name), observables[n][at]);
    }
    text += "   </Grid>\n";
  }
  return text;
}

}  // namespace

std::filesystem::path write_xdmf(const std::filesystem::path& trajectory) {
  const TrajectoryReader reader(trajectory);
  const auto beside = [&trajectory](const char* extension) {
    return std::filesystem::path(trajectory).replace_extension(extension);
  };
  const std::filesystem::path views = beside(".frames.hdf5");
  write_views(reader, views);
  std::filesystem::path path = beside(".xdmf");
  write_durably(
      path,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n"
      "  <Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
          grids(reader, views.filename().string()) + "  </Grid>\n </Domain>\n</Xdmf>\n");
  return path;
}

}  // namespace hemoscale::micro
