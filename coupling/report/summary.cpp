#include "coupling/report/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "coupling/error.hpp"
#include "coupling/report/report_file.hpp"

namespace hemoscale::coupling {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "HemoScale summary";
constexpr int format_version = 1;

/// JSON knows no infinity and no NaN: both become null.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double to_number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::string state_of(const micro::LedgerEntry& entry) {
  // Written so that a deviation that is not a number counts as the worst.
  if (!(entry.deviation <= entry.stop_above)) return "stop";
  return entry.deviation <= entry.warn_above ? "good" : "warn";
}

Json to_json(const Summary& summary) {
  Json figures = Json::array();
  for (const Figure& figure : summary.figures) {
    Json entry{{"name", figure.name}, {"value", number(figure.value)}, {"unit", figure.unit}};
    if (figure.standard_error) entry["standard_error"] = number(*figure.standard_error);
    figures.push_back(std::move(entry));
  }
  Json timings = Json::object();
  for (const auto& [part, timing] : summary.timings) {
    timings[part] = {{"wall [s]", number(timing.wall)},
                     {"cpu [s]", number(timing.cpu)},
                     {"calls", timing.calls}};
  }
  Json ledger = Json::array();
  for (const micro::LedgerEntry& entry : summary.ledger) {
    ledger.push_back({{"name", entry.name},
                      {"deviation", number(entry.deviation)},
                      {"warn_above", number(entry.warn_above)},
                      {"stop_above", number(entry.stop_above)},
                      {"state", state_of(entry)}});
  }
  const Host& host = summary.host;
  return {{"format", {{"name", format_name}, {"version", format_version}}},
          {"title", summary.title},
          {"outcome", summary.outcome},
          {"statements", summary.statements},
          {"warnings", summary.warnings},
          {"figures", std::move(figures)},
          {"conservation", std::move(ledger)},
          {"timings", std::move(timings)},
          {"version", summary.version},
          {"seed", summary.seed},
          {"identity", summary.identity},
          {"host",
           {{"name", host.name},
            {"processor", host.processor},
            {"processors", host.processors},
            {"threads", host.threads},
            {"ranks", host.ranks}}},
          {"settings", summary.settings}};
}

Summary from_json(const Json& json) {
  Summary summary;
  json.at("title").get_to(summary.title);
  json.at("outcome").get_to(summary.outcome);
  json.at("statements").get_to(summary.statements);
  json.at("warnings").get_to(summary.warnings);
  json.at("version").get_to(summary.version);
  json.at("seed").get_to(summary.seed);
  json.at("identity").get_to(summary.identity);
  json.at("settings").get_to(summary.settings);
  for (const Json& entry : json.at("figures")) {
    Figure figure{entry.at("name").get<std::string>(), to_number(entry.at("value")),
                  entry.at("unit").get<std::string>()};
    if (entry.contains("standard_error")) {
      figure.standard_error = to_number(entry.at("standard_error"));
    }
    summary.figures.push_back(std::move(figure));
  }
  for (const auto& [part, entry] : json.at("timings").items()) {
    summary.timings[part] = {to_number(entry.at("wall [s]")), to_number(entry.at("cpu [s]")),
                             entry.at("calls").get<std::int64_t>()};
  }
  for (const Json& entry : json.at("conservation")) {
    summary.ledger.push_back({entry.at("name").get<std::string>(), to_number(entry.at("deviation")),
                              to_number(entry.at("warn_above")),
                              to_number(entry.at("stop_above"))});
  }
  const Json& host = json.at("host");
  host.at("name").get_to(summary.host.name);
  host.at("processor").get_to(summary.host.processor);
  host.at("processors").get_to(summary.host.processors);
  host.at("threads").get_to(summary.host.threads);
  host.at("ranks").get_to(summary.host.ranks);
  return summary;
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  // Names come from the user's files and may hold bytes that are not UTF-8; these become U+FFFD.
  constexpr auto policy = Json::error_handler_t::replace;
  replace_file(path, to_json(summary).dump(2, ' ', false, policy) + "\n");
}

Summary read_summary(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    const Json& format = json.at("format");
    if (format.at("name") != format_name || format.at("version") != format_version) {
      throw EnvironmentError(path.string() +
                             ": this is not a summary of this version of HemoScale");
    }
    return from_json(json);
  } catch (const Json::exception& error) {
    throw EnvironmentError(
        fmt::format("{}: this is not a whole summary: {}", path.string(), error.what()));
  }
}

}  // namespace hemoscale::coupling
