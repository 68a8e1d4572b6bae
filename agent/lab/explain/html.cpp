#include "agent/lab/explain/html.hpp"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "agent/base/text.hpp"

namespace gazed::lab::explain::html {

namespace {

constexpr int jpeg_quality = 88;  // thin lines stay clean

// Nothing of it is fetched from anywhere; the policy makes the browser refuse if anything were.
constexpr std::string_view head_of_page = R"(<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<style>
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #222; background: #fff;
       max-width: 1280px; margin: 0 auto; padding: 1rem 1.5rem 4rem; }
h1 { font-size: 1.6rem; margin-bottom: .2rem; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .5rem; border-bottom: 1px solid #ccc; }
p { max-width: 60rem; }
.answer { font-size: 1.25rem; }
.status { display: inline-block; padding: .1rem .6rem; border-radius: .3rem; color: #fff; font-weight: bold; }
.good { background: #00734f; } .doubt { background: #8a5a00; } .bad { background: #a83200; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .8rem; margin: .4rem 0 1.4rem; }
figure { margin: 0; } figcaption { font-size: .9rem; color: #444; }
img { max-width: 100%; height: auto; display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .92rem; }
th, td { padding: .2rem .6rem; text-align: right; border-bottom: 1px solid #ddd; }
td { white-space: nowrap; } td.words { white-space: normal; min-width: 16rem; }
th { border-bottom: 2px solid #888; vertical-align: bottom; }
th:first-child, td:first-child, td.words { text-align: left; }
.legend { list-style: none; padding: 0; columns: 2; font-size: .92rem; }
.legend li { padding-left: 1.7em; text-indent: -1.7em; break-inside: avoid; }
.legend span { text-indent: 0; }
.legend span { display: inline-block; width: 1.1em; height: 1.1em; margin-right: .5em; vertical-align: text-bottom;
               border: 1px solid #333; }
.quiet { color: #555; font-size: .92rem; }
@media (max-width: 700px) { .pair { grid-template-columns: 1fr; } .legend { columns: 1; } }
</style>
)";

std::string img(std::string_view media_type, std::string_view bytes, std::string_view alt) {
  return "<img alt=\"" + escaped(alt) + "\" src=\"data:" + std::string(media_type) + ";base64," +
         base64(bytes) + "\">\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : base::excerpt(text, std::string::npos)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return out;
}

std::string image(const cv::Mat& bgr, std::string_view alt) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality})) {
    throw std::runtime_error("a picture of the page cannot be encoded as JPEG");
  }
  return img("image/jpeg", std::string(bytes.begin(), bytes.end()), alt);
}

std::string svg_image(std::string_view svg, std::string_view alt) {
  return img("image/svg+xml", svg, alt);
}

std::string table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<div class=\"wide\"><table>\n<tr>";
  for (const std::string& cell : header) out += "<th>" + escaped(cell) + "</th>";
  out += "</tr>\n";
  for (const std::vector<std::string>& row : rows) {
    out += "<tr>";
    for (const std::string& cell : row) {
      constexpr std::size_t longest_number = 24;
      out += (cell.size() > longest_number ? "<td class=\"words\">" : "<td>") + escaped(cell) +
             "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::string page(std::string_view title, std::string_view body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<title>" + escaped(title) + "</title>\n" +
         std::string(head_of_page) + "</head>\n<body>\n" + std::string(body) + "</body>\n</html>\n";
}

}  // namespace gazed::lab::explain::html
