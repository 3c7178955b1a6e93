#include <fmt/format.h>

#include <cmath>

#include "campaign/store.h"
#include "campaign/store_header.h"

namespace gapscope {
namespace {

/// A cell of a CSV table; in quotes where it needs them.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

struct RowWriter {
  std::string line;
  void add(const std::string& text) { line += (line.empty() ? "" : ",") + cell(text); }
  void operator()(const std::string& name, std::string& text) {
    if (name != "configuration") add(text);
  }
  void operator()(const std::string&, double& value) {
    add(std::isnan(value) ? "" : fmt::format("{}", value));
  }
  void operator()(const std::string&, std::optional<bool>& value) {
    add(!value ? "" : *value ? "true" : "false");
  }
};

}  // namespace

void export_campaign(const CampaignStore& store, bool times,
                     const std::function<void(const std::string&)>& write) {
  store.each([](CampaignRow&, CampaignTiming&) {});  // what is damaged is refused before a word is written
  RowWriter header;
  for (const std::string& name : internal::campaign::run_columns(store.header()))
    if (name != "configuration") header.add(name);
  if (times)
    for (const std::string& name : internal::campaign::timing_columns()) header.add(name);
  write(header.line + "\n");
  store.each([&](CampaignRow& row, CampaignTiming& timing) {
    RowWriter out;
    out.add(fmt::format("{}", row.run + 1));
    for (const std::string& value : row.point) out.add(value);
    fields(out, row);
    if (times) fields(out, timing);
    write(out.line + "\n");
  });
}

}  // namespace gapscope
