#include "report/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/page_assets.h"

namespace pigment::report {
namespace {

std::string palette(bool on_dark) {
  std::string out;
  for (std::size_t i = 0; i < 8; ++i) out += fmt::format("--s{}:{};", i + 1, to_hex(series_colour(i, on_dark)));
  return out;
}

std::string palette_style() {
  return ":root{" + palette(false) + "}\n@media screen and (prefers-color-scheme:dark){:root{" +
         palette(true) + "}}\n";
}

}  // namespace

HtmlReport::HtmlReport(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void HtmlReport::close_section() {
  if (open_) body_ += "</section>\n";
  open_ = false;
}

void HtmlReport::chapter(const std::string& title) {
  close_section();
  const std::string anchor = fmt::format("run{}", chapters_.size() + 1);
  chapters_.emplace_back(anchor, title);
  body_ += fmt::format("<h2 class=\"chapter\" id=\"{}\">{}</h2>\n", anchor, html_escape(title));
}

void HtmlReport::section(const std::string& title, const std::string& text) {
  close_section();
  const std::string anchor = fmt::format("section{}", sections_.size() + 1);
  sections_.emplace_back(anchor, title);
  body_ += fmt::format("<section id=\"{}\"><h2>{}</h2>\n", anchor, html_escape(title));
  if (!text.empty()) body_ += "<p>" + html_escape(text) + "</p>\n";
  open_ = true;
}

void HtmlReport::headlines(const std::vector<Headline>& numbers) {
  body_ += "<dl class=\"headlines\">\n";
  for (const Headline& h : numbers) {
    body_ += fmt::format("<div><dt>{}</dt><dd><b>{}</b>{}</dd>", html_escape(h.label), html_escape(h.value),
                         h.unit.empty() ? "" : " <span>" + html_escape(h.unit) + "</span>");
    if (!h.note.empty()) body_ += "<dd class=\"note\">" + html_escape(h.note) + "</dd>";
    body_ += "</div>\n";
  }
  body_ += "</dl>\n";
}

void HtmlReport::plots(const std::vector<Plot>& plots) {
  body_ += "<div class=\"plots\">\n";
  for (const Plot& p : plots) {
    body_ += plot_figure(p, fmt::format("plot{}", ++plots_));
    drawn_.push_back({chapters_.empty() ? "" : chapters_.back().second, sections_.empty() ? "" : sections_.back().second, p});
  }
  body_ += "</div>\n";
}

void HtmlReport::images(const std::vector<CaptionedImage>& images, const std::string& note) {
  body_ += "<div class=\"pictures\">\n";
  for (const CaptionedImage& i : images)
    body_ += fmt::format(
        "<figure{}><img alt=\"{}\" width=\"{}\" height=\"{}\" "
        "src=\"{}\"><figcaption>{}</figcaption></figure>\n",
        i.time ? fmt::format(" data-time=\"{:.9g}\"", *i.time) : "", html_escape(i.description), i.image.width, i.image.height, png_data_uri(i.image),
        html_escape(i.caption));
  body_ += "</div>\n";
  if (!note.empty()) body_ += "<p class=\"note\">" + html_escape(note) + "</p>\n";
}

void HtmlReport::colours(const ColourLegend& legend) {
  body_ += "<div class=\"colours\"><span>" + html_escape(legend.label) + "</span>";
  for (std::size_t i = 0; i < legend.names.size(); ++i)
    body_ += fmt::format("<span class=\"tint\"><i style=\"background:{}\"></i>{}</span>",
                         html_escape(legend.colours[i]), html_escape(legend.names[i]));
  if (legend.names.empty()) {
    body_ += fmt::format("<div class=\"bar\"><i style=\"background:linear-gradient(90deg,{})\"></i>",
                         html_escape(fmt::format("{}", fmt::join(legend.colours, ","))));
    for (const auto& [position, label] : legend.labels)
      body_ += fmt::format("<span style=\"left:{:.1f}%\">{}</span>", 100 * position, html_escape(label));
    body_ += "</div>";
  }
  body_ += "</div>\n";
}

void HtmlReport::figures(const std::vector<StudyFigure>& figures) {
  body_ += "<div class=\"sheets\">\n";
  for (const StudyFigure& f : figures)
    body_ += fmt::format("<figure{2}><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                         html_escape(f.caption), f.data_uri, f.wide ? " class=\"wide\"" : "");
  body_ += "</div>\n";
}

void HtmlReport::table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       TableStyle style) {
  const bool verdicts = style == TableStyle::VerdictFirst;
  body_ += fmt::format("<div class=\"scroll\"><table{}>", verdicts ? " class=\"claims\"" : "");
  if (!head.empty()) {
    body_ += "<thead><tr>";
    for (const std::string& h : head) body_ += "<th>" + html_escape(h) + "</th>";
    body_ += "</tr></thead>";
  }
  body_ += "<tbody>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = html_escape(row[i]);
      if (verdicts && i == 0) {
        std::string name = cell;
        std::replace(name.begin(), name.end(), ' ', '-');
        body_ += fmt::format("<td><span class=\"verdict {}\">{}</span></td>", name, cell);
      } else {
        body_ += "<td>" + cell + "</td>";
      }
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlReport::folded(const std::string& summary, const std::string& preformatted) {
  body_ += "<details><summary>" + html_escape(summary) + "</summary><pre>" + html_escape(preformatted) +
           "</pre></details>\n";
}

void HtmlReport::remark(const std::string& text) {
  body_ += "<p class=\"remark\">" + html_escape(text) + "</p>\n";
}

void HtmlReport::viewer(const std::string& json, const std::string& packed, const std::string& note) {
  has_viewer_ = true;
  body_ += "<figure class=\"viewer\" hidden><figcaption>The layer in three dimensions</figcaption>"
           "<p class=\"viewer-missing\"></p><div class=\"viewer-body\"></div>"
           "<p class=\"note\">" + html_escape(note) + "</p>\n";
  body_ += "<script type=\"application/json\" class=\"layers\">" + json + "</script>\n" + packed + "</figure>\n";
}

std::string HtmlReport::page() const {
  std::string contents;
  for (const auto& [anchor, title] : chapters_.empty() ? sections_ : chapters_)
    contents += fmt::format("<a href=\"#{}\">{}</a>", anchor, html_escape(title));
  std::string out = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'; "
      "script-src 'unsafe-inline'\">\n";
  out +=
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
      "content=\"light dark\">\n";
  out += "<link rel=\"icon\" href=\"data:,\">\n<title>" + html_escape(title_) + "</title>\n<style>\n" +
         palette_style() + page_style;
  if (has_viewer_) out += page_viewer_css;
  out += "</style>\n</head>\n<body>\n";
  out += "<header><h1>" + html_escape(title_) + "</h1>";
  if (!subtitle_.empty()) out += "<p>" + html_escape(subtitle_) + "</p>";
  if (plots_ > 0)
    out += "<p class=\"hint\">Plots: point for values, drag to zoom, click the names to switch curves. Sliders move all that shows "
           "the same times.</p>";
  out += "</header>\n<nav>" + contents + "</nav>\n<main>\n" + body_ + (open_ ? "</section>\n" : "") +
         "</main>\n";
  const auto script = [&out](std::string_view text) { ((out += "<script>\n") += text) += "</script>\n"; };
  script(page_clock_js);
  script(page_plots_js);
  if (has_viewer_)
    for (const auto text : {page_three_min_js, page_layer_data_js, page_layer_scene_js, page_viewer_colours_js, page_viewer_js})
      script(text);
  return out + "</body>\n</html>\n";
}

}  // namespace pigment::report
