#include <gmock/gmock.h>

#include "report/html_page.h"
#include "report/plain_markdown.h"
#include "report/report.h"
#include "report/sample_run.h"
#include "results/scratch_folder.h"
#include "support/reading.h"
#include "support/told.h"

namespace gapscope {
namespace {

using internal::report::html_body;
using internal::report::html_line;
using internal::report::plain_markdown;
using ::testing::HasSubstr;
using testing::line_with;
using ::testing::Not;

TEST(Html, ALineKeepsItsTextAndTakesNoMarkupOfItsOwn) {
  EXPECT_EQ(html_line("**a** < *b* & `c*d*` [w](#words)"),
            "<b>a</b> &lt; <i>b</i> &amp; <code>c*d*</code> <a href=\"#words\">w</a>");
  EXPECT_EQ(html_line("<script>"), "&lt;script&gt;");
  EXPECT_EQ(html_line("[x](http://a.b)"), "[x](http://a.b)") << "links leave the page nowhere";
  EXPECT_EQ(html_line("2 * 3"), "2 * 3");
}

TEST(PlainMarkdown, TakesWhatBeginsHtmlOrFetchesAPictureForText) {
  EXPECT_EQ(plain_markdown("a <img src=x>.csv, 2 < 3, <, ![x](http://a.b)\n"),
            "a &lt;img src=x>.csv, 2 < 3, <, &#33;[x](http://a.b)\n");
  EXPECT_EQ(plain_markdown("</b> <!-- <?php \\<b>"), "&lt;/b> &lt;!-- &lt;?php \\&lt;b>");
  for (const char* own : {"![rig: overview](overview.png)\n", "![x1 [rad] over t < 3 s](a_1.png)\n"})
    EXPECT_EQ(plain_markdown(own), own);
  for (const char* picture :
       {"![a](http://b/c.png)", "![a](//b.png)", "![a](http://b) ](c.png)", "![a] <b>](c.png)"})
    EXPECT_TRUE(plain_markdown(picture).starts_with("&#33;[a]")) << picture;
}

TEST(PlainMarkdown, LeavesCodeAloneWhereNoReaderCouldSeeOtherCode) {
  EXPECT_EQ(plain_markdown("`compensation_<law>.csv` and ``a ` <b>``"),
            "`compensation_<law>.csv` and ``a ` <b>``");
  EXPECT_EQ(plain_markdown("| `a<b>` |"), "| `a<b>` |");
  for (const char* odd : {"``a`<img>`", "\\`<img>`", "one `\n`<img>` two", "| `a | <img>` |", "`<img>` ``"})
    EXPECT_THAT(plain_markdown(odd), HasSubstr("&lt;img>")) << odd;
}

TEST(Html, TablesHaveHeadingsAndRows) {
  const std::string body = html_body("| a | b |\n|---|---|\n| 1\\|2 | `c` |\n", {});
  EXPECT_THAT(body, HasSubstr("<thead><tr><th>a</th><th>b</th></tr>"));
  EXPECT_THAT(body, HasSubstr("<tr><td>1|2</td><td><code>c</code></td></tr>"));
}

TEST(Html, ANumberKeepsItsUnitBesideItAndASentenceIsBroken) {
  const std::string body =
      html_body("| a b | c |\n|---|---|\n| 4.31 mN·m | a remark that may well take several lines |\n", {});
  EXPECT_THAT(body, HasSubstr("<th>a b</th>"));
  EXPECT_TOLD(line_with(body, "<td class=\"short\">4.31 mN·m</td><td class=\"long\">a"));
}

TEST(Html, APictureSaysHowManyColumnsItsLettersAreMadeFor) {
  EXPECT_THAT(html_body("![t](a.png)\n", {{"a.png", "<svg>x</svg>"}}),
              HasSubstr("<figure><svg>x</svg></figure>"));
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), sample_run({.samples = 6000}));
  write_report(scratch.path.string());
  const std::string page = testing::text_of(scratch.path / "report.html");
  EXPECT_THAT(page, HasSubstr("style=\"--columns:2\""));
  EXPECT_THAT(page, HasSubstr("style=\"--columns:1\""));
}

TEST(Html, ANameThatIsMarkupIsTextInBothReports) {
  ScratchFolder scratch;
  RunResult run = sample_run({.samples = 6000});
  const std::string name = "<img src=x onerror=alert(1)> ![x](http://a.b)";
  run.notes.push_back("`" + name + "` and " + name);
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string report = testing::text_of(scratch.path / "report.md");
  EXPECT_THAT(report, HasSubstr(" and &lt;img src=x onerror=alert(1)> &#33;[x](http://a.b)"));
  EXPECT_THAT(testing::text_of(scratch.path / "report.html"),
              HasSubstr(" and &lt;img src=x onerror=alert(1)&gt; ![x](http://a.b)"));
}

TEST(Html, SectionsFoldAndAreClosedOneByOne) {
  const std::string body = html_body("# t\n\n- x\n\n## Words\n\n- y\n\n## Notes\n\ntext\n", {});
  EXPECT_THAT(body, HasSubstr("<h1>t</h1>\n<ul class=\"card\">\n<li>x</li>\n</ul>\n<details id=\"words\">"));
  EXPECT_THAT(body, HasSubstr("</ul>\n</details>\n<details id=\"notes\">"));
}

TEST(Html, OfAReportAsksTheNetworkAndOtherFilesForNothing) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), sample_run({.samples = 6000}));
  write_report(scratch.path.string());
  const std::string page = testing::text_of(scratch.path / "report.html");
  const std::string report = testing::text_of(scratch.path / "report.md");
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<svg "); at != page.npos; at = page.find("<svg ", at + 1)) ++pictures;
  std::size_t listed = 0;
  for (std::size_t at = report.find("]("); at != report.npos; at = report.find("](", at + 1))
    listed += report[at + 2] != '#';
  EXPECT_GT(pictures, 5U);
  EXPECT_EQ(pictures, listed) << "every picture of report.md";
  for (const char* asks : {"http:", "https:", "//cdn", "<link", "@import", "src=", "fetch(", "XMLHttp"})
    EXPECT_THAT(page, Not(HasSubstr(asks)));
  for (std::size_t at = page.find("url("); at != page.npos; at = page.find("url(", at + 1))
    EXPECT_EQ(page[at + 4], '#') << "a place in the page itself";
  for (std::size_t at = page.find("href="); at != page.npos; at = page.find("href=", at + 1))
    EXPECT_EQ(page.substr(at, 7), "href=\"#");
}

TEST(Html, ThePictureThatCarriesTheAnswerStandsUnderTheCardAndOnce) {
  const std::vector<internal::report::Picture> pictures = {{"a.png", "<svg>a</svg>"},
                                                           {"b.png", "<svg>b</svg>"}};
  const std::string body =
      html_body("# t\n\n- x\n\n## Figures\n\n![a](a.png)\n![b](b.png)\n", pictures, "<p>head</p>\n", "b.png");
  EXPECT_THAT(body, HasSubstr("<h1>t</h1>\n<p>head</p>\n<ul"));
  EXPECT_THAT(body, HasSubstr("</ul>\n<figure><svg>b</svg></figure>\n<details"));
  EXPECT_EQ(body.find("<svg>b"), body.rfind("<svg>b"));
  EXPECT_LT(body.find("<details"), body.find("<svg>a"));
}

TEST(Html, SaysWhatItIsOfAndHowFarTheAnswerGoes) {
  ScratchFolder scratch;
  RunResult run = sample_run({.samples = 6000});
  run.answer.emplace().trust = AnswerTrust::kLimited;
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string page = testing::text_of(scratch.path / "report.html");
  EXPECT_THAT(page, HasSubstr("<span class=\"badge limited\">gap: limited</span>"));
  EXPECT_THAT(page, HasSubstr("<p class=\"about\">"));
  EXPECT_THAT(page, HasSubstr("<rect class=\"plot\"")) << "what the cursor reads";
}

}  // namespace
}  // namespace gapscope
