// One growing step over the faces that may grow; used by grow() alone. New elements are appended to the
// arrays of the mesh in groups of bounded size, so that only a group's arguments exist twice.
#pragma once

#include <initializer_list>
#include <string_view>

#include "representations/procedural_mesh/growing/expansion.h"

namespace terrabench::growing {

struct Active {
  std::uint32_t face = 0, state = 0, parameters = 0;  // parameters: how many
};

class Wave {
 public:
  Wave(const RuleSystem&, GrownMesh&, const GrowOptions&);

  // Replaces the active faces that have a rule. Afterwards `active` holds the new faces that may grow and the
  // old ones that may still grow later; faces that cannot grow before this call of grow() ends go to
  // `resting`. Returns the number of faces replaced.
  std::size_t run(std::vector<Active>& active, std::vector<Active>& resting);

  // Whether the faces that were replaced take more memory than those that live.
  bool should_drop() const;
  // Removes the faces that were replaced, and the states and parameters of all but the listed faces. States
  // then lie in the order of the lists, whose numbers are adapted.
  void drop_replaced(std::initializer_list<std::vector<Active>*> lists);

 private:
  struct Chosen {
    Active active;
    const Rule* rule = nullptr;
    Slots to;
    std::uint32_t end_face = 0;
    std::uint32_t first_base_texture = 0;
    Failure failure;
  };
  void choose(const std::vector<Active>& active);
  const Rule* rule_for(const Active&, Failure&) const;
  // Returns where the group ends.
  std::size_t lay_out(std::size_t first);
  void check_limits(const Counts&, std::size_t replaced, std::size_t replaced_corners) const;
  void reserve(const Counts&, std::size_t base_corners, std::size_t first, std::size_t last);
  [[noreturn]] void fail_beyond(std::size_t limit, std::string_view what) const;
  void expand_group(std::size_t first, std::size_t last);
  void expand_one(Chosen&);
  void keep_states(std::size_t first, std::size_t last, std::vector<Active>& next,
                   std::vector<Active>& resting);
  void average_texture();
  bool selected(std::uint32_t symbol) const { return only_.empty() || only_[symbol]; }
  [[noreturn]] void fail(const Failure&, const Active&) const;

  const RuleSystem& system_;
  GrownMesh& grown_;
  const std::vector<bool>& only_;
  const Limits limits_;
  std::vector<bool> replaced_;                     // per face
  std::size_t removed_ = 0, removed_corners_ = 0;  // since they were dropped last
  std::size_t made_ = 0;                           // new faces so far
  std::vector<bool> retries_;  // per symbol: whether its rules may apply later to a face that they left alone
  std::uint32_t stride_ = 0;   // most parameters of a symbol
  std::vector<Chosen> chosen_;
  NewArguments arguments_;
  std::vector<FaceShape> shapes_;  // of the group's new faces
  std::vector<CornerTexture> base_texture_;
  std::vector<glm::dvec2> sums_;
  std::vector<std::uint32_t> shares_;
};

}  // namespace terrabench::growing
