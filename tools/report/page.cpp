#include "tools/report/page.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::report {

namespace {

// Readable on a telephone, on paper and in the dark.
constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8884; --soft: #8881; --strong: #b5432a; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin-bottom: .3rem; }
h2 { font-size: 1.2rem; margin-top: 2.2rem; border-bottom: 1px solid var(--line); padding-bottom: .2rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
figure { margin: 1rem 0; }
figure img, figure video { width: 100%; height: auto; background: white; border-radius: 4px; }
figure svg { width: 100%; height: auto; }
figcaption { font-size: .85rem; opacity: .8; }
pre { background: var(--soft); padding: .8rem; overflow-x: auto; font-size: .8rem; }
.status { display: inline-block; padding: .1rem .6rem; border-radius: 4px; background: #2b7a4b; color: white; }
.status.bad { background: var(--strong); }
.bar { display: inline-block; height: .7rem; background: #3d4a8f; }
)";

constexpr const char* base64_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(const std::string& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= bytes.size() - i ? base64_letters[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string row_html(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return html + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string figure(double value) {
  if (std::abs(value) < 1e15 && value == std::round(value)) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

std::string data_url(const std::filesystem::path& file, const std::string& media_type) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw RunError(fmt::format("{}: cannot be read", file.string()));
  return fmt::format("data:{};base64,{}", media_type, base64(bytes));
}

void Page::heading(const std::string& text) {
  body_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void Page::paragraph(const std::string& html) {
  body_ += fmt::format("<p>{}</p>\n", html);
}

void Page::table(const Rows& rows) {
  body_ += "<div class=\"scroll\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) body_ += row_html(rows[i], i == 0 ? "th" : "td");
  body_ += "</table></div>\n";
}

void Page::facts(const Rows& rows) {
  body_ += "<div class=\"scroll\"><table>\n";
  for (const auto& row : rows) body_ += row_html(row, "td");
  body_ += "</table></div>\n";
}

void Page::folded(const std::string& summary, const std::string& text) {
  body_ += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", escaped(summary), escaped(text));
}

void Page::figure_with(const std::string& html, const std::string& caption) {
  body_ += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", html, escaped(caption));
}

std::string Page::html() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n{2}</body></html>\n",
      escaped(title_), style, body_);
}

}  // namespace scree::report
