#include "app/report/page.h"

#include <fmt/format.h>

#include "engine/image/inline_picture.h"

namespace stereonav {
namespace {

// Styles of the page. Wide tables scroll on their own, so that the page never scrolls sideways.
constexpr const char* kStyle = R"css(
:root{color-scheme:light dark;--page:#fff;--ink:#1c1f24;--soft:#5b6470;--line:#d9dde3;--card:#f6f7f9;
--front:#2a7d3f;--accent:#c2410c;--s0:#1f5fbf;--s1:#b4540a;--s2:#7a3fb0;--s3:#0f766e;--s4:#b91c4b;--s5:#57606a}
@media (prefers-color-scheme:dark){:root{--page:#14161a;--ink:#e6e8ec;--soft:#9aa3af;--line:#343a44;--card:#1d2026;
--front:#5cc47a;--accent:#fb923c;--s0:#7db0ff;--s1:#f0a35e;--s2:#c79bf2;--s3:#5fd0c5;--s4:#f58aa8;--s5:#aab2bd}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1180px;padding:16px;background:var(--page);color:var(--ink);
font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;overflow-wrap:break-word}
h1{font-size:1.6rem;margin:.2em 0}h2{font-size:1.25rem;margin:2em 0 .3em;border-bottom:1px solid var(--line)}
h3{font-size:1rem;margin:.2em 0}p{margin:.4em 0;max-width:75ch}a{color:var(--s0)}
.soft{color:var(--soft)}.warn{border-left:4px solid var(--accent);padding:.3em .8em;background:var(--card)}
.blocks{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,430px),1fr));
grid-auto-flow:dense;gap:16px}
.card{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px;min-width:0}
.wide{grid-column:1/-1}.verdict{font-weight:600}
nav a{display:inline-block;margin-right:1em}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}
th,td{padding:2px 8px 2px 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--line);white-space:nowrap}
td.words{white-space:normal;min-width:14em}td.note{white-space:normal;color:var(--soft);padding-bottom:.8em}tr.default td:first-child{color:var(--accent);font-weight:600}
details summary{cursor:pointer;color:var(--soft)}
figure{margin:0}figure img{width:100%;height:auto;display:block}figcaption{font-size:.85rem;color:var(--soft)}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,250px),1fr));gap:8px}
svg.chart{width:100%;height:auto;max-width:560px;display:block}
svg text.ink{fill:var(--ink);paint-order:stroke;stroke:var(--card);stroke-width:3px;stroke-linejoin:round}svg .grid{stroke:var(--line);stroke-width:.7}svg .frame{fill:none;stroke:var(--soft)}
svg .front{fill:none;stroke:var(--front);stroke-width:2;opacity:.8}svg .join{fill:none;stroke-width:1.5}
svg .spread{stroke:var(--soft);stroke-width:1}svg .default{fill:none;stroke:var(--accent);stroke-width:2}
svg .dot.s0{fill:var(--s0)}svg .dot.s1{fill:var(--s1)}svg .dot.s2{fill:var(--s2)}svg .dot.s3{fill:var(--s3)}
svg .dot.s4{fill:var(--s4)}svg .dot.s5{fill:var(--s5)}svg .join.s0{stroke:var(--s0)}svg .join.s1{stroke:var(--s1)}
svg .join.s2{stroke:var(--s2)}svg .join.s3{stroke:var(--s3)}svg .join.s4{stroke:var(--s4)}svg .join.s5{stroke:var(--s5)}
.fail{color:var(--accent);font-weight:600}
@media print{:root{--page:#fff;--ink:#000;--soft:#444;--line:#bbb;--card:#fff;--front:#2a7d3f;--accent:#c2410c;
--s0:#1f5fbf;--s1:#b4540a;--s2:#7a3fb0;--s3:#0f766e;--s4:#b91c4b;--s5:#57606a}
body{max-width:none;font-size:10pt}.card{break-inside:avoid}nav{display:none}details::details-content{content-visibility:visible}}
)css";

std::string paragraph(const std::string& text, const char* kind = "") {
    if (text.empty()) return "";
    return fmt::format("<p{}>{}</p>\n", *kind ? fmt::format(" class=\"{}\"", kind) : "", escapedXml(text));
}

std::string heading(const std::string& title) {
    return title.empty() ? "" : "<h3>" + escapedXml(title) + "</h3>\n";
}

// Returns a table cell; long text may be broken into lines.
std::string cell(const std::string& text, const char* element) {
    constexpr std::size_t kLongCell = 36;
    const char* kind = text.size() > kLongCell ? " class=\"words\"" : text == "FAIL" ? " class=\"fail\"" : "";
    return fmt::format("<{0}{1}>{2}</{0}>", element, kind, escapedXml(text));
}

std::string tableOf(const std::vector<std::string>& columns,
                    const std::vector<std::vector<std::string>>& rows, const std::vector<bool>& marked = {},
                    const std::vector<std::string>& notes = {}) {
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& column : columns) html += cell(column, "th");
    html += "</tr></thead><tbody>\n";
    for (std::size_t n = 0; n < rows.size(); ++n) {
        html += n < marked.size() && marked[n] ? "<tr class=\"default\">" : "<tr>";
        const bool goesOn =
            n > 0 && n < notes.size() && notes[n] == notes[n - 1] && rows[n][0] == rows[n - 1][0];
        for (std::size_t c = 0; c < rows[n].size(); ++c)
            html += cell(c == 0 && goesOn ? "" : rows[n][c], "td");
        html += "</tr>\n";
        if (n < notes.size() && (n + 1 == rows.size() || notes[n + 1] != notes[n]))
            html += fmt::format("<tr><td class=\"note\" colspan=\"{}\">{}</td></tr>\n", columns.size(),
                                escapedXml(notes[n]));
    }
    return html + "</tbody></table></div>\n";
}

Chart drawingOf(const WayChart& ways) {
    Chart chart;
    chart.title = ways.title;
    chart.xLabel = ways.timeLabel;
    chart.yLabel = ways.errorLabel;
    chart.front = ways.front;
    chart.yKind = ChartScale::Kind::Logarithmic;
    ChartSeries series;
    for (const WayPoint& p : ways.points) {
        const Spread& t = p.way.time;  // the dot is the least time, as for fronts; the bar ends at the median
        series.points.push_back(
            {p.way.name, {t.low, t.low, t.median, t.count}, exactly(p.way.error), p.way.isDefault});
        if (p.worstError > p.way.error && !ways.front) series.points.back().y.high = p.worstError;
    }
    series.joined = !ways.front;
    chart.series.push_back(std::move(series));
    return chart;
}

std::string figuresOf(const WayChart& ways) {
    std::vector<std::string> columns{"way", ways.timeLabel, ways.errorLabel, "worst"};
    if (!ways.points.empty())
        for (const auto& other : ways.points.front().others) columns.push_back(other.first);
    columns.push_back("what");
    std::vector<std::vector<std::string>> rows;
    std::vector<bool> marked;
    for (const WayPoint& p : ways.points) {
        std::vector<std::string> row{p.way.name + (p.way.isDefault ? " (default)" : ""),
                                     spreadText(p.way.time), numberText(p.way.error),
                                     numberText(p.worstError)};
        for (const auto& other : p.others) row.push_back(numberText(other.second));
        row.push_back(p.detail);
        rows.push_back(std::move(row));
        marked.push_back(p.way.isDefault);
    }
    return tableOf(columns, rows, marked);
}

bool isDefaultBeaten(const std::vector<Way>& ways) {
    for (std::size_t n = 0; n < ways.size(); ++n)
        if (ways[n].isDefault && !verdictOf(ways, n).onFront) return true;
    return false;
}

std::string blockOf(const WayChart& ways) {
    std::vector<Way> all;
    for (const WayPoint& p : ways.points) all.push_back(p.way);
    std::string html = "<div class=\"card\">" + heading(ways.title) + svgOf(drawingOf(ways));
    if (ways.front) html += paragraph(frontText(all), "verdict");
    html += paragraph(isDefaultBeaten(all) ? ways.why : "") + paragraph(ways.text, "soft") +
            paragraph(ways.setting + ".", "soft");
    return html + "<details><summary>figures</summary>" + figuresOf(ways) + "</details></div>\n";
}

std::string blockOf(const LineChart& chart) {
    return "<div class=\"card\">" + heading(chart.chart.title) + svgOf(chart.chart) +
           paragraph(chart.text, "soft") + "</div>\n";
}

std::string blockOf(const ReportTable& table) {
    return "<div class=\"card wide\">" + heading(table.title) + paragraph(table.text, "soft") +
           tableOf(table.columns, table.rows, {}, table.notes) + "</div>\n";
}

std::string blockOf(const ReportPictures& pictures) {
    std::string html = "<div class=\"card wide\">" + heading(pictures.title) +
                       paragraph(pictures.text, "soft") + "<div class=\"pictures\">\n";
    for (const ReportPicture& p : pictures.pictures)
        html += fmt::format(
            "<figure><img alt=\"{0}\" "
            "src=\"data:image/png;base64,{1}\"/><figcaption>{0}</figcaption></figure>\n",
            escapedXml(p.title), base64(p.png));
    return html + "</div></div>\n";
}

std::string blockOf(const ReportText& text) {
    return "<div class=\"card wide\">" + paragraph(text.text) + "</div>\n";
}

std::string sectionOf(const ReportSection& section) {
    std::string html =
        fmt::format("<section id=\"{}\"><h2>{}</h2>\n", escapedXml(section.id), escapedXml(section.title)) +
        paragraph(section.text) + "<div class=\"blocks\">\n";
    for (const ReportBlock& block : section.blocks)
        html += std::visit([](const auto& b) { return blockOf(b); }, block);
    return html + "</div></section>\n";
}

}  // namespace

std::string pageOf(const Report& report) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<title>stereonav report</title>\n<style>" +
        std::string(kStyle) + "</style></head><body>\n<h1>stereonav report</h1>\n";
    html += paragraph(
        "What the program's shortcuts cost and save. In each chart lower is less error and further left is "
        "less time. The green line is the Pareto front: nothing else is better in both. A ring marks the "
        "default. A dot lies at the least time of its repeats, because other work on the machine only adds "
        "time; a thin bar reaches to their median. Tables have the median and, in brackets, the least and "
        "the most.");
    for (const std::string& warning : report.warnings) html += paragraph(warning, "warn");
    html += "<nav>";
    for (const ReportSection& s : report.sections)
        html += fmt::format("<a href=\"#{}\">{}</a>", escapedXml(s.id), escapedXml(s.title));
    html += "</nav>\n";
    for (const ReportSection& s : report.sections) html += sectionOf(s);
    html += "<section id=\"run\"><h2>This run</h2><div class=\"scroll\"><table><tbody>\n";
    for (const auto& [name, value] : report.machine)
        html += "<tr>" + cell(name, "th") + cell(value, "td") + "</tr>\n";
    return html + "</tbody></table></div></section>\n</body></html>\n";
}

}  // namespace stereonav
