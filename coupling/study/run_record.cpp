#include "coupling/study/run_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "coupling/error.hpp"
#include "coupling/report/report_file.hpp"

namespace hemoscale::coupling {

namespace {

using Json = nlohmann::ordered_json;
using Status = RunRecord::Status;

constexpr const char* format_name = "HemoScale run of a study";

Status status_of(const std::string& text) {
  for (const Status status : {Status::finished, Status::failed, Status::timed_out}) {
    if (status_text(status) == text) return status;
  }
  throw EnvironmentError("the status is '" + text + "'");
}

}  // namespace

std::string status_text(Status status) {
  switch (status) {
    case Status::finished:
      return "finished";
    case Status::failed:
      return "failed";
    case Status::timed_out:
      return "timed out";
  }
  return "";
}

void write_record(const std::filesystem::path& file, const RunRecord& record) {
  const Json json = {
      {"format", format_name},
      {"identity", record.identity},
      {"build", record.build},
      {"status", status_text(record.status)},
      {"message", record.message},
      {"cpu [s]", record.cpu},
      {"wall [s]", record.wall},
      {"repeats", record.repeats},
      {"jobs", record.jobs},
      {"longest [s]", std::isfinite(record.longest) ? Json(record.longest) : Json(nullptr)}};
  replace_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<RunRecord> read_record(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  const std::string text = read_file(file);
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != format_name) throw EnvironmentError("it is of another format");
    RunRecord record;
    json.at("identity").get_to(record.identity);
    json.at("build").get_to(record.build);
    record.status = status_of(json.at("status").get<std::string>());
    json.at("message").get_to(record.message);
    json.at("cpu [s]").get_to(record.cpu);
    json.at("wall [s]").get_to(record.wall);
    json.at("repeats").get_to(record.repeats);
    json.at("jobs").get_to(record.jobs);
    const Json& longest = json.at("longest [s]");
    record.longest =
        longest.is_null() ? std::numeric_limits<double>::infinity() : longest.get<double>();
    return record;
  } catch (const std::exception& error) {
    throw EnvironmentError(
        fmt::format("{}: this is not the record of a run: {}; remove the folder, or run with "
                    "--fresh",
                    file.string(), error.what()));
  }
}

}  // namespace hemoscale::coupling
