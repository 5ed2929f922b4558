// Sets of a claims file that are not listed there: taken from the registries, or derived from another set.
//
//   [sets]
//   type = {of = "representations"}
//   caster = {of = "representations", with = ["rays"], except = ["voxel"]}
//   approximate = {of = "representations", without = ["lossless", "materials"]}
//   open_scene = {of = "scene", without = ["overhangs"]}
//
// The members of `of` that have all fields of `with`, none of `without`, and are not named in `except`, in
// their order. `of` is a listed set of the file, or one that was declared. results/ knows no method, so the
// program declares the methods at start-up (experiments/method_sets.h). The methods are
// not taken from the records: a claim's content would then depend on the folder that is judged, and a method
// that was not measured would go unnoticed.
#pragma once

#include "results/claims/toml_reader.h"

namespace terrabench {

using Sets = std::map<std::string, std::vector<SetMember>, std::less<>>;

// To be called once, before a claims file is read.
void declare_sets(Sets);

// Adds the sets that are tables to the file's listed ones. Throws bad_input for an unknown set, a name in
// `except` that is none of its members, and an empty result.
void derive_sets(const toml::table& sets, TomlFile&);

}  // namespace terrabench
