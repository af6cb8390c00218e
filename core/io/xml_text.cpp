#include "core/io/xml_text.hpp"

#include "core/base/lines.hpp"

namespace treejet {

namespace {

bool has_no_place_in_xml(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string all;
  for (const char c : utf8(text)) {
    if (c == '&')
      all += "&amp;";
    else if (c == '<')
      all += "&lt;";
    else if (c == '>')
      all += "&gt;";
    else if (c == '"')
      all += "&quot;";
    else if (c == '\'')
      all += "&apos;";
    else if (has_no_place_in_xml(c))
      all += "\uFFFD";
    else
      all += c;
  }
  return all;
}

std::string xml_comment(std::string_view text) {
  std::string all = "<!-- ";
  for (const char c : utf8(text)) {
    if (c == '-' && all.back() == '-') continue;
    all += has_no_place_in_xml(c) ? '?' : c;
  }
  return all + " -->";
}

}  // namespace treejet
