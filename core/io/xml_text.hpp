#pragma once
/// Text from outside (names of columns, units, files) as XML and HTML take it, between tags and in quotes.
///
/// The five characters of markup become entities. A control character, which XML 1.0 has no way to say,
/// becomes U+FFFD, and what is not UTF-8 is taken for Latin-1 (core/base/lines.hpp): any bytes give a
/// document that can be read.

#include <string>
#include <string_view>

namespace treejet {

std::string xml_text(std::string_view text);

/// A comment of any text, in which no two hyphens stand together, nor one at the end.
std::string xml_comment(std::string_view text);

}  // namespace treejet
