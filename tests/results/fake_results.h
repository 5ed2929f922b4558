// Results folders with plausible measurements, to exercise what reads them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>

#include "results/claims/claims.h"
#include "results/store/record.h"
#include "results/store/store.h"
#include "terrain/files.h"

namespace terrabench {

// A folder of its own for each test, gone afterwards.
class FolderTest : public testing::Test {
 protected:
  FolderTest();
  ~FolderTest() override;
  std::string content() const { return read_file(file()); }
  std::filesystem::path file() const { return folder_ / "measurements.jsonl"; }

  std::filesystem::path folder_;
};

Provenance fake_provenance();
Record fake_record(const Provenance&, std::string experiment, std::string case_name,
                   std::string profile = "quick");
void add(Record&, std::string metric, std::string unit, std::vector<double> samples);

// The paper "p" with these entries of a claims file.
Paper paper_of(std::string_view entries);
// The paper with one claim, "p.1", of this class: its `check`, and further lines after it.
Paper paper_with_claim(std::string_view type, std::string_view check, std::string_view more = "");

// Entries of a claims file, which are titled by their ids; `more`: further lines. A claim's statement is
// "states ID", at "w"; a table's and a plot's metrics are of the experiment "e".
std::string claim_entry(std::string_view id, std::string_view check, std::string_view more = "");
std::string table_entry(std::string_view id, std::string_view rows, std::string_view columns,
                        std::string_view more = "");
std::string plot_entry(std::string_view id, std::string_view series, std::string_view more = "");

// The papers that write_fake_results() measures.
std::span<const Paper> faked_papers();

// All that the hybrid experiments measure in this profile, figures included, every known verdict met.
void write_fake_results(const std::filesystem::path& folder, const std::string& profile);

// How often a text holds a part.
std::size_t count(std::string_view text, std::string_view part);

// Replaces one stretch of the measurements file, as an editor would.
void edit(const std::filesystem::path& file, std::string_view from, std::string_view to);

}  // namespace terrabench
