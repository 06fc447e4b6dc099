#pragma once

#include <string>
#include <string_view>

namespace io {

/// The text with & < > and " as entities, fit for the text and the attributes of XML, SVG and HTML.
std::string xml_escaped(std::string_view text);

}  // namespace io
