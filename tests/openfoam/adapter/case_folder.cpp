#include "tests/openfoam/adapter/case_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hemoscale::test {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

fs::path library_file() {
  return fs::path(HEMOSCALE_BINARY_DIR) / HEMOSCALE_LIBRARY_FOLDER / "libhemoscale_openfoam.so";
}

std::string missing_openfoam() {
  if (!fs::exists(library_file())) {
    return "the OpenFOAM plug-in is not part of this build (no " + library_file().string() + ")";
  }
  if (std::system("command -v simpleFoam >/dev/null && command -v blockMesh >/dev/null") != 0) {
    return "OpenFOAM's programs are not on the PATH";
  }
  return {};
}

CaseFolder::CaseFolder() {
  std::string pattern = (fs::temp_directory_path() / "hemoscale-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

CaseFolder::~CaseFolder() {
  if (::testing::Test::HasFailure()) {
    std::fprintf(stderr, "the case is kept in %s\n", path_.c_str());
    return;
  }
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void CaseFolder::copy_from(const fs::path& folder) {
  fs::copy(folder, path_, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

void CaseFolder::write(const std::string& file, const std::string& text) const {
  fs::create_directories((path_ / file).parent_path());
  std::ofstream(path_ / file) << text;
}

void CaseFolder::append(const std::string& file, const std::string& text) const {
  std::ofstream(path_ / file, std::ios::app) << text;
}

std::string CaseFolder::read(const std::string& file) const {
  std::ifstream stream(path_ / file);
  if (!stream) throw std::runtime_error("cannot read " + (path_ / file).string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

void CaseFolder::replace(const std::string& file, const std::string& before,
                         const std::string& after) const {
  std::string text = read(file);
  const std::size_t place = text.find(before);
  if (place == std::string::npos || text.find(before, place + 1) != std::string::npos) {
    throw std::runtime_error("'" + before + "' does not occur once in " + file);
  }
  write(file, text.replace(place, before.size(), after));
}

Outcome CaseFolder::run(const std::string& command,
                        const std::map<std::string, std::string>& more) const {
  std::map<std::string, std::string> environment = {
      {"HEMOSCALE_OPENFOAM_LIBRARY", library_file().string()}, {"OMP_NUM_THREADS", "1"}};
  if (std::getenv("WM_PROJECT_DIR") == nullptr) {
    environment["WM_PROJECT_DIR"] = "/usr/share/openfoam";
  }
  for (const auto& [name, value] : more) environment[name] = value;
  std::string line = "cd " + quoted(path_.string()) + " && exec env";
  for (const auto& [name, value] : environment) line += " " + quoted(name + "=" + value);
  line += " timeout 280 sh -c " + quoted(command) + " 2>&1";
  std::FILE* pipe = ::popen(line.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start a shell");
  Outcome result;
  std::array<char, 4096> buffer{};
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0) {
    result.output.append(buffer.data(), count);
  }
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::string CaseFolder::mpirun(int ranks) {
  std::string command = "mpirun --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 ";
  if (::geteuid() == 0) command += "--allow-run-as-root ";
  return command + "-np " + std::to_string(ranks);
}

std::vector<std::vector<double>> read_field(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::string word;
  while (stream >> word && word != "internalField") {
  }
  stream >> word;
  std::size_t count = 1;
  if (word == "nonuniform") stream >> word >> count >> word;  // List<...> N (
  std::vector<std::vector<double>> values(count);
  for (std::vector<double>& value : values) {
    stream >> std::ws;
    if (stream.peek() == '(') {
      std::string text;
      stream.get();
      std::getline(stream, text, ')');
      std::istringstream components(text);
      for (double x = 0; components >> x;) value.push_back(x);
    } else {
      value.resize(1);
      stream >> value[0];
    }
    if (!stream) throw std::runtime_error("cannot understand " + file.string());
  }
  return values;
}

void make_channel(CaseFolder& folder, Scale scale, int cells_across) {
  folder.copy_from(fs::path(HEMOSCALE_SOURCE_DIR) / "cases/channel-feedback/openfoam");
  const std::string controls = folder.read("system/controlDict");
  folder.write("system/controlDict", controls.substr(0, controls.find("functions")));
  folder.replace("system/channel", "cellsAcross     80;",
                 "cellsAcross     " + std::to_string(cells_across) + ";");
  if (scale == Scale::metre) {
    for (const auto& [before, after] : std::map<std::string, std::string>{
             {"lengthUnit      1e-6;", "lengthUnit      1;"},
             {"timeUnit        1e-3;", "timeUnit        1;"},
             {"height          100;", "height          1e-4;"},
             {"meanVelocity    3.3333333333;", "meanVelocity    3.3333333333e-3;"},
             {"length          100;", "length          1e-4;"},
             {"depth           1;", "depth           1e-6;"}}) {
      folder.replace("system/channel", before, after);
    }
  }
}

}  // namespace hemoscale::test
