#include "coupling/study/this_build.hpp"

#include <link.h>

#include <algorithm>
#include <vector>

#include "coupling/report/report_file.hpp"
#include "micro/snapshot/checksum.hpp"

namespace hemoscale::coupling {

namespace {

int add_library(dl_phdr_info* info, std::size_t, void* files) {
  const std::string name = info->dlpi_name;
  if (name.find("/libhemoscale") != std::string::npos) {
    static_cast<std::vector<std::string>*>(files)->push_back(name);
  }
  return 0;
}

std::string checksum_of_code() {
  std::vector<std::string> files;
  dl_iterate_phdr(add_library, &files);
  std::sort(files.begin(), files.end());
  files.emplace_back("/proc/self/exe");
  std::string sums;
  for (const std::string& file : files)
    sums += micro::to_hexadecimal(micro::checksum(read_file(file)));
  return micro::to_hexadecimal(micro::checksum(sums));
}

}  // namespace

const std::string& this_build() {
  static const std::string digits = checksum_of_code();
  return digits;
}

}  // namespace hemoscale::coupling
