// Pieces of a page that stands by itself.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gazed::lab::explain::html {

/// For text between tags and inside of quotes; what is no UTF-8 or a control character becomes '?'.
[[nodiscard]] std::string escaped(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// An <img> that holds its picture (8UC3), as JPEG. `alt` says in words what it shows. Throws
/// std::runtime_error when it cannot be encoded.
[[nodiscard]] std::string image(const cv::Mat& bgr, std::string_view alt);
/// One that holds an SVG file's text.
[[nodiscard]] std::string svg_image(std::string_view svg, std::string_view alt);

/// A table of cells that are text.
[[nodiscard]] std::string table(const std::vector<std::string>& header,
                                const std::vector<std::vector<std::string>>& rows);

/// A whole page: its title, and what is between <body> and </body>.
[[nodiscard]] std::string page(std::string_view title, std::string_view body);

}  // namespace gazed::lab::explain::html
