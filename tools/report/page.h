// One self-contained HTML page, built from the top down.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree::report {

// Text as it stands in HTML.
std::string escaped(const std::string& text);

// A figure with four digits: "0.02184", "1.2e-09"; a whole number in full.
std::string figure(double value);

// A file as it stands inside a page. Throws RunError if it cannot be read.
std::string data_url(const std::filesystem::path& file, const std::string& media_type);

// Cells are HTML. The first row is the head.
using Rows = std::vector<std::vector<std::string>>;

class Page {
 public:
  explicit Page(std::string title) : title_(std::move(title)) {}

  void heading(const std::string& text);
  void paragraph(const std::string& html);
  void table(const Rows& rows);
  // Names and values, without a head.
  void facts(const Rows& rows);
  void add(const std::string& html) { body_ += html; }
  // Closed until the reader opens it.
  void folded(const std::string& summary, const std::string& text);
  // A picture or chart with words below it.
  void figure_with(const std::string& html, const std::string& caption);

  [[nodiscard]] std::string html() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace scree::report
