#include "agent/lab/explain/html.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <string>

namespace gazed::lab::explain::html_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The test vectors of RFC 4648, section 10.
TEST(Base64, IsThatOfItsRfc) {
  EXPECT_EQ(html::base64(""), "");
  EXPECT_EQ(html::base64("f"), "Zg==");
  EXPECT_EQ(html::base64("fo"), "Zm8=");
  EXPECT_EQ(html::base64("foo"), "Zm9v");
  EXPECT_EQ(html::base64("foob"), "Zm9vYg==");
  EXPECT_EQ(html::base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(html::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(html::base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(Html, WhatSomebodyWroteStaysText) {
  EXPECT_EQ(html::escaped("<b a=\"1\">x & 'y'</b>"),
            "&lt;b a=&quot;1&quot;&gt;x &amp; &#39;y&#39;&lt;/b&gt;");
  EXPECT_EQ(html::escaped("± µ"), "± µ");
  EXPECT_EQ(html::escaped("a\xff\nb"), "a??b");
}

TEST(Html, APictureIsInsideOfThePage) {
  const std::string image =
      html::image(cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 255)), "a \"red\" one");
  EXPECT_THAT(image,
              StartsWith("<img alt=\"a &quot;red&quot; one\" src=\"data:image/jpeg;base64,/9j/"));
}

TEST(Html, ATableEscapesItsCells) {
  EXPECT_THAT(html::table({"<h>"}, {{"<c>"}}),
              HasSubstr("<th>&lt;h&gt;</th></tr>\n<tr><td>&lt;c&gt;</td>"));
}

TEST(Html, APageMayFetchNothing) {
  const std::string page = html::page("1 < 2", "<p>body</p>\n");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("<title>1 &lt; 2</title>"));
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
}

}  // namespace
}  // namespace gazed::lab::explain::html_test
