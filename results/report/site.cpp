#include "results/report/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "terrain/files.h"

namespace terrabench {
namespace {

// Puts the targets of links into one form; `page`: the name of the page's own file.
class Resolver {
 public:
  Resolver(const PageForm& form, std::string_view page) : form_(form), page_(page) {}

  void operator()(std::string& target) const {
    if (const std::size_t at = target.find(".*"); at != target.npos)
      target.replace(at + 1, 1, form_.extension);
    if (target.size() > page_.size() && target.starts_with(page_) && target[page_.size()] == '#')
      target.erase(0, page_.size());
  }
  void operator()(std::vector<Link>& links) const {
    for (Link& link : links) (*this)(link.target);
  }
  void operator()(Paragraph& paragraph) const { (*this)(paragraph.links); }
  void operator()(Gallery& gallery) const {
    for (Picture& picture : gallery.pictures) {
      (*this)(picture.links);
      (*this)(picture.target);
    }
  }
  void operator()(TableBlock& block) const {
    (*this)(block.links);
    for (std::vector<Cell>& row : block.table.rows) {
      for (Cell& cell : row) (*this)(cell.link);
    }
  }
  void operator()(Bars& bars) const {
    for (Bars::Bar& bar : bars.bars) (*this)(bar.label.target);
  }
  void operator()(Search& search) const { (*this)(search.page); }
  void operator()(Heading&) const {}
  void operator()(Facts&) const {}
  void operator()(Doors&) const {}

 private:
  const PageForm& form_;
  std::string_view page_;
};

std::string file_of(std::string_view stem, const PageForm& form) {
  return stem.empty() ? std::string(form.main_page) : fmt::format("{}.{}", stem, form.extension);
}

}  // namespace

void Site::add(std::string stem, std::string group, std::string label, Document document) {
  const auto at = stem.empty() ? pages_.begin() : pages_.end();
  pages_.insert(at, {std::move(stem), std::move(group), std::move(label), std::move(document)});
}

void Site::write(const std::filesystem::path& folder, std::string_view first_line) const {
  for (const Page& page : pages_) {
    for (const PageForm& form : {kHtmlForm, kMarkdownForm}) {
      const std::string file = file_of(page.stem, form);
      Document document = page.document;
      for (Block& block : document) std::visit(Resolver(form, file), block);
      const Navigation navigation = navigation_of(page, form);
      const bool is_html = form.extension == kHtmlForm.extension;
      write_file(folder / file,
                 is_html ? std::string(page.stem.empty() ? first_line : "") + html(document, navigation)
                         : markdown(document, navigation));
    }
  }
}

// To every page, and to this one in the other form.
Navigation Site::navigation_of(const Page& here, const PageForm& form) const {
  Navigation navigation;
  for (const Page& page : pages_) {
    auto group = std::ranges::find(navigation, page.group, &Navigation::value_type::first);
    if (group == navigation.end()) group = navigation.insert(group, {page.group, {}});
    group->second.push_back({page.label, &page == &here ? "#top" : file_of(page.stem, form)});
  }
  const bool is_html = form.extension == kHtmlForm.extension;
  navigation.front().second.push_back(
      {is_html ? "Markdown" : "HTML", file_of(here.stem, is_html ? kMarkdownForm : kHtmlForm)});
  return navigation;
}

}  // namespace terrabench
