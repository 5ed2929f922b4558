// The subcommands of the command line, one function and one file each. They print to standard output, throw
// Error for whatever the user can mend, and return the exit code.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/error.h"

namespace terrabench {

struct ListArguments {
  std::string what;  // representations, lods, experiments, claims, terrains; empty: all
  bool json = false;
};
ExitCode list_command(const ListArguments&);

struct RepresentArguments {
  std::string terrain, as;
  std::vector<std::string> assignments;
  std::string save, render;   // files to write; empty: none
  std::string write_flow;     // likewise: flow accumulation, and beside it the directions
  std::vector<int> crop;      // i, j, width, depth
  std::vector<int> resample;  // width, depth
  bool fill = false;          // fill no-data holes
  int view_width = 1600, view_height = 1000;
  std::string renderer = "osmesa";
  std::uint64_t seed = 1;
};
ExitCode represent_command(const RepresentArguments&);

struct CheckArguments {
  std::filesystem::path folder = "out", junit;
  std::vector<std::string> rows;  // ids or globs; empty: all
  bool json = false;
};
ExitCode check_command(const CheckArguments&);

struct CompareArguments {
  std::filesystem::path before, after;
  bool json = false;
};
ExitCode compare_command(const CompareArguments&);

ExitCode report_command(const std::filesystem::path& folder);

// Tells a DEM, a saved structure and a results folder apart by content.
ExitCode info_command(const std::filesystem::path&);

}  // namespace terrabench
