// What claims, tables, plots and rankings read is measured: each of their cases is one of its experiment's.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "experiments/experiment.h"
#include "results/claims/claims.h"

namespace terrabench {
namespace {

constexpr std::pair<std::string_view, Profile> kProfiles[] = {
    {"quick", Profile::kQuick}, {"paper", Profile::kPaper}, {"scale", Profile::kScale}};

using Names = std::set<std::pair<std::string, std::string>>;  // experiments and cases

// As `run --profile` chooses them.
Names measured_in(Profile profile) {
  Names names;
  RunOptions options;
  options.profile = profile;
  for (const Experiment& one : experiments()) {
    if (one.profile_scale != (profile == Profile::kScale)) continue;
    for (const Case& at : one.cases(options)) {
      EXPECT_TRUE(names.emplace(one.id, at.name).second) << one.id << ' ' << at.name << " is there twice";
    }
  }
  return names;
}

TEST(ReadCases, AClaimsCasesAreMeasuredInItsProfiles) {
  for (const auto& [name, profile] : kProfiles) {
    const Names measured = measured_in(profile);
    for (const Paper& paper : papers()) {
      for (const Claim& claim : paper.claims) {
        if (std::ranges::count(claim.profiles, name) == 0) continue;
        for (const Condition& condition : claim.conditions) {
          for (const Operand& operand : condition.operands) {
            EXPECT_TRUE(operand.is_number() || measured.contains({operand.experiment, operand.case_name}))
                << claim.id << " reads " << operand.experiment << '/' << operand.case_name << " in " << name;
          }
        }
      }
    }
  }
}

TEST(ReadCases, WhatTheReportShowsIsMeasuredInSomeProfile) {
  Names measured;
  for (const auto& [name, profile] : kProfiles) measured.merge(measured_in(profile));
  const auto check = [&](const std::string& id, const std::string& experiment, const std::string& name) {
    EXPECT_TRUE(measured.contains({experiment, name})) << id << " shows " << experiment << '/' << name;
  };
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      for (const TableLayout::Row& row : table.rows) check(table.id, table.experiment, row.case_name);
    }
    for (const PlotLayout& plot : paper.plots) {
      for (const PlotLayout::Series& series : plot.series) {
        for (const auto& [x, name] : series.cases) check(plot.id, series.experiment, name);
      }
    }
    for (const RankingLayout& ranking : paper.rankings) {
      for (const RankingLayout::Entry& entry : ranking.entries) {
        check(ranking.id, ranking.experiment, entry.case_name);
      }
    }
  }
}

}  // namespace
}  // namespace terrabench
