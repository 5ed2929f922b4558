#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/commands/commands.h"
#include "experiments/experiment.h"
#include "experiments/grass_cover.h"
#include "lod/lod.h"
#include "renderers/landscape/style.h"
#include "representations/procedural_mesh/model.h"
#include "representations/representation.h"
#include "results/claims/claims.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(std::span<const ParameterSpec> specs) {
  Json list = Json::array();
  for (const ParameterSpec& spec : specs) {
    Json entry = {
        {"name", spec.name}, {"unit", spec.unit}, {"help", spec.help}, {"accepts", accepted_values(spec)}};
    std::visit([&](const auto& value) { entry["default"] = value; }, spec.fallback);
    if (std::isfinite(spec.lowest)) entry["lowest"] = spec.lowest;
    if (std::isfinite(spec.highest)) entry["highest"] = spec.highest;
    if (!spec.allowed.empty()) entry["allowed"] = std::vector(spec.allowed.begin(), spec.allowed.end());
    list.push_back(std::move(entry));
  }
  return list;
}

Json list_representations() {
  Json list = Json::array();
  for (const RepresentationType& type : representations()) {
    list.push_back({{"name", type.name},
                    {"summary", type.summary},
                    {"paper", type.paper},
                    {"overhangs", type.traits.overhangs},
                    {"materials", type.traits.materials},
                    {"lossless", type.traits.lossless},
                    {"editable", type.traits.editable},
                    {"events", type.traits.events},
                    {"erodes", type.traits.erodes},
                    {"rays", type.traits.rays},
                    {"parameters", parameters_json(type.parameters)}});
  }
  return list;
}

Json list_lods() {
  Json list = Json::array();
  for (const LodType& type : lods()) {
    Json variants = Json::array();
    for (const LodVariant& variant : type.variants)
      variants.push_back(
          {{"name", fmt::format("{}_{}", type.name, variant.name)}, {"option", variant.option}});
    list.push_back({{"name", type.name},
                    {"summary", type.summary},
                    {"paper", type.paper},
                    {"conforming", type.traits.conforming},
                    {"bounds_error", type.traits.bounds_error},
                    {"near_surface", type.traits.near_surface},
                    {"variants", std::move(variants)},
                    {"knob",
                     {{"name", type.knob.name},
                      {"unit", type.knob.unit},
                      {"finest", type.knob.finest},
                      {"coarsest", type.knob.coarsest},
                      {"default", type.knob.fallback}}},
                    {"parameters", parameters_json(type.parameters)}});
  }
  return list;
}

Json list_experiments() {
  Json list = Json::array();
  for (const Experiment& experiment : experiments()) {
    list.push_back({{"name", experiment.id},
                    {"summary", experiment.title},
                    {"paper", experiment.paper()},
                    {"parameters", parameters_json(experiment.parameters)}});
  }
  return list;
}

Json list_claims() {
  Json list = Json::array();
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      list.push_back({{"name", claim.id},
                      {"summary", claim.statement},
                      {"paper", paper.id},
                      {"where", claim.where},
                      {"experiments", claim.experiments()},
                      {"class", std::string(1, claim.claim_class)},
                      {"expected", name(claim.expected())}});
    }
  }
  return list;
}

Json list_terrains() {
  Json list = Json::array();
  for (const TerrainType& terrain : terrains()) {
    list.push_back({{"name", terrain.name}, {"summary", terrain.summary}, {"origin", terrain.origin}});
  }
  list.push_back({{"name", fmt::format("{}FILE.png", kDrawingPrefix)},
                  {"summary",
                   "land from your own picture, from black (sea bed) to white (peaks); may be followed by "
                   ",cell=30,sea_level=0.3,peak=1000,seabed=0.1,smoothing=2,mountains=0.6"},
                  {"origin", "the MRBSP paper's drawings"}});
  list.push_back(
      {{"name", fmt::format("{}FILE", kDemPrefix)},
       {"summary",
        "an elevation model, read as options say: ,band=1,nodata=-9999,unit=ft,encoding=terrarium; without "
        "options, its path alone (docs/grounds.md)"},
       {"origin", "GDAL"}});
  return list;
}

Json list_models() {
  Json list = Json::array();
  for (const std::string& name : growing::model_names()) {
    const growing::Model model = growing::parse_model(growing::model_text(name), name);
    list.push_back({{"name", name}, {"summary", model.title}, {"bytes", model.bytes}});
  }
  return list;
}

Json list_scene() {
  return Json::array(
      {{{"name", "landscape"},
        {"summary", "how `terrabench render --scene` draws: light, sky, fog, materials and water"},
        {"parameters", parameters_json(landscape_parameters())}},
       {{"name", "grass"},
        {"summary", "grass on the near surface that `--lod hybrid` draws"},
        {"parameters", parameters_json(grass_parameters())}}});
}

struct Listing {
  std::string_view name;
  Json (*list)();
};
constexpr std::array kListings{
    Listing{"representations", list_representations},
    Listing{"lods", list_lods},
    Listing{"experiments", list_experiments},
    Listing{"claims", list_claims},
    Listing{"terrains", list_terrains},
    Listing{"models", list_models},
    Listing{"scene", list_scene},
};

// " (Table 2; run mrbsp.walk)": where a claim stands in its paper, and what measures it.
std::string source_of(const Json& entry) {
  if (!entry.contains("where")) return "";
  std::string text = entry["where"].get<std::string>();
  std::string_view separator = text.empty() ? "run" : "; run";
  for (const Json& experiment : entry["experiments"]) {
    text += fmt::format("{} {}", std::exchange(separator, ""), experiment.get<std::string>());
  }
  return text.empty() ? "" : fmt::format(" ({})", text);
}

Json of_paper(const Json& list, std::string_view paper) {
  Json those = Json::array();
  for (const Json& entry : list) {
    if (entry["paper"] == paper) those.push_back(entry);
  }
  return those;
}

void print_text(std::string_view title, const Json& list) {
  std::size_t width = 0;
  for (const Json& entry : list) width = std::max(width, entry["name"].get_ref<const std::string&>().size());
  fmt::print("{}\n", title);
  for (const Json& entry : list) {
    fmt::print("  {:<{}}  {}{}\n", entry["name"].get<std::string>(), width,
               entry["summary"].get<std::string>(), source_of(entry));
    if (!entry.contains("parameters")) continue;
    for (const Json& parameter : entry["parameters"]) {
      fmt::print("  {:<{}}    --set {}={}  {} ({})\n", "", width, parameter["name"].get<std::string>(),
                 parameter["default"].dump(), parameter["help"].get<std::string>(),
                 parameter["accepts"].get<std::string>());
    }
  }
}

}  // namespace

ExitCode list_command(const ListArguments& arguments) {
  Json chosen = Json::object();
  std::vector<std::string_view> known;
  for (const Listing& listing : kListings) {
    known.push_back(listing.name);
    if (arguments.what.empty() || arguments.what == listing.name)
      chosen[std::string(listing.name)] = listing.list();
  }
  for (const Paper& paper : papers()) {
    known.push_back(paper.id);
    if (arguments.what != paper.id) continue;
    chosen["experiments"] = of_paper(list_experiments(), paper.id);
    chosen["claims"] = of_paper(list_claims(), paper.id);
  }
  if (chosen.empty()) throw unknown_name("listing", arguments.what, known);
  if (arguments.json) {
    fmt::print("{}\n", chosen.dump(2));
    return ExitCode::kGood;
  }
  for (const auto& [title, list] : chosen.items()) print_text(title, list);
  return ExitCode::kGood;
}

}  // namespace terrabench
