// SPDX-License-Identifier: Apache-2.0
// The report as one HTML page: style, script and pictures are inside.
#include <bench/pareto.hpp>
#include <bench/report.hpp>
#include <bench/svg.hpp>
#include <core/image_io.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace brume::bench {
namespace {

constexpr const char* kStyle =
    "body{font:14px sans-serif;max-width:80em;margin:2em auto;padding:0 1em;background:#fff;"
    "color:#222}svg{width:100%;max-width:640px}svg text{font-size:10px;fill:#333}"
    ".grid{stroke:#ddd}.front{fill:none;stroke:#c40;stroke-width:1.5}.best{fill:#c40}"
    ".rest{fill:#579}table{border-collapse:collapse;font-size:12px}.scroll{overflow-x:auto}"
    "th{cursor:pointer;background:#eee;position:sticky;top:0}td,th{padding:2px 8px;border-bottom:1px "
    "solid #ddd;text-align:right;white-space:nowrap}td.t,th.t{text-align:left}code{font-size:11px}"
    ".strip{display:flex;flex-wrap:wrap;gap:8px}figure{margin:0;font-size:11px}figure img{width:240px;"
    "image-rendering:pixelated;display:block}.pair{display:flex}figcaption code{white-space:normal;"
    "display:block;max-width:480px}";

/// Sorts by numbers where the cells begin with some; again the other way round.
constexpr const char* kScript = R"(
function valueOf(row, column) {
  const text = row.cells[column].textContent.trim();
  const number = parseFloat(text);
  return Number.isNaN(number) ? text : number;
}
function sortTable(table, column) {
  const body = table.tBodies[0], isDown = table.dataset.sorted === String(column);
  const rows = Array.from(body.rows).map((row, index) => ({row, index, value: valueOf(row, column)}));
  const order = (a, b) => {
    const isText = [a, b].map(entry => typeof entry.value === 'string');
    if (isText[0] !== isText[1]) return isText[0] ? 1 : -1;
    const by = isText[0] ? a.value.localeCompare(b.value) : a.value - b.value;
    return (isDown ? -by : by) || a.index - b.index;
  };
  rows.sort(order);
  for (const entry of rows) body.append(entry.row);
  table.dataset.sorted = isDown ? '' : String(column);
}
for (const table of document.querySelectorAll('table'))
  Array.from(table.tHead.rows[0].cells).forEach((cell, column) =>
    cell.addEventListener('click', () => sortTable(table, column)));
const wanted = /^#sort=([\w-]+):(\d+)$/.exec(location.hash);
if (wanted) sortTable(document.getElementById(wanted[1]), Number(wanted[2]));
document.body.dataset.ready = 'yes';
)";

std::string encodeBase64(const std::vector<unsigned char>& bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes.size() * 4 / 3 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= left ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string drawImage(const Image& image, const std::string& what) {
    if (image.isEmpty()) return {};
    return fmt::format("<img alt='{}' src='data:image/png;base64,{}'>", escapeHtml(what),
                       encodeBase64(encodePng(image)));
}

/// Ids of tables, in order: "table-0".
class Page {
  public:
    void add(const std::string& html) { mHtml += html; }

    void add(const Table& table) {
        mHtml += fmt::format("<h3>{}</h3>\n<div class='scroll'><table id='table-{}'><thead><tr>",
                             escapeHtml(table.title), mTableCount++);
        const auto addCell = [&](const char* tag, std::size_t column, const std::string& text) {
            mHtml += fmt::format("<{0}{1}>{2}</{0}>", tag,
                                 column < table.textColumns ? " class='t'" : "", escapeHtml(text));
        };
        for (std::size_t i = 0; i < table.header.size(); ++i) addCell("th", i, table.header[i]);
        mHtml += "</tr></thead><tbody>\n";
        for (const Cells& cells : table.rows) {
            mHtml += "<tr>";
            for (std::size_t i = 0; i < table.header.size(); ++i)
                addCell("td", i, i < cells.size() ? cells[i] : "-");
            mHtml += "</tr>\n";
        }
        mHtml += "</tbody></table></div>\n";
        for (const std::string& note : table.notes)
            mHtml += "<p>" + escapeHtml(note) + "</p>\n";
    }

    std::string take() { return std::move(mHtml); }

  private:
    std::string mHtml;
    int mTableCount = 0;
};

/// Result and amplified difference of each method of a group, the reference before them.
void addStrip(std::span<const Measurement> measurements, const std::string& group, Page& page) {
    bool hasReference = false;
    for (const Measurement& m : measurements) {
        if (describeGroup(m.row) != group || m.image.isEmpty()) continue;
        if (!hasReference) page.add("<div class='strip'>\n");
        if (!hasReference && m.reference)
            page.add("<figure>" + drawImage(*m.reference, "reference") +
                     "<figcaption>reference</figcaption></figure>\n");
        hasReference = true;
        std::string pictures = drawImage(m.image, m.row.method);
        if (!m.absolute.empty())
            pictures += drawImage(paintErrors(m.absolute, m.image.width, m.image.height),
                                  "difference of " + m.row.method);
        page.add(fmt::format("<figure><div class='pair'>{}</div><figcaption>{}: {:.3g} ms{}<code>{}"
                             "</code></figcaption></figure>\n",
                             pictures, escapeHtml(m.row.method), m.row.time.median,
                             m.row.error ? fmt::format(", rmse {:.2e}", m.row.error->rmse) : "",
                             escapeHtml(m.row.command)));
    }
    if (hasReference) page.add("</div>\n");
}

void addGroups(std::span<const Measurement> measurements, Page& page) {
    page.add("<h2 id='scenes'>Error against time</h2>\n<p>rmse in linear radiance against ms; the line "
             "joins the methods that no other beats in both. Pictures: result and difference, black up to "
             "1e-6, blue 1e-5, green 1e-3, yellow 1e-2, red 1e-1, white from 1.</p>\n");
    std::vector<std::string> drawn;
    for (const Measurement& m : measurements) {
        const std::string group = describeGroup(m.row);
        if (std::find(drawn.begin(), drawn.end(), group) != drawn.end()) continue;
        drawn.push_back(group);
        const std::string plot = drawParetoPlot(measurements, group);
        if (plot.empty() && m.image.isEmpty()) continue;
        page.add("<h3>" + escapeHtml(group) + "</h3>\n" + plot);
        addStrip(measurements, group, page);
    }
}

Table makeCommandTable(const Results& results) {
    Table table{.title = "Commands that repeat each row",
                .header = {"scene", "method", "command"},
                .textColumns = 3};
    for (const Measurement& m : results.frames)
        table.rows.push_back({m.row.scene, m.row.method, m.row.command});
    for (const ShadowRow& row : results.shadows)
        table.rows.push_back({row.scene, row.store, row.command});
    for (const SimulationCost& cost : results.simulation)
        table.rows.push_back({"simulate", cost.name, cost.command});
    return table;
}

void addSummary(const Results& results, Page& page) {
    page.add(fmt::format("<h1>Brume: benchmark</h1>\n<p id='machine'>{}.</p>\n<p>Times are medians, "
                         "methods in turn. Made by <code>{}</code></p>\n",
                         escapeHtml(describeMachine(results.machine)), escapeHtml(results.command)));
    const std::set<std::string> dominated = findDominated(results.frames);
    page.add(dominated.empty()
                 ? std::string("<p>Every method is on the front of some scene.</p>\n")
                 : fmt::format("<p>Beaten in both time and error on every scene here: {}.</p>\n",
                               escapeHtml(fmt::format("{}", fmt::join(dominated, ", ")))));
    for (const std::string& failure : listFailures(results))
        page.add("<p>Failed: " + escapeHtml(failure) + "</p>\n");
}

}  // namespace

std::string makePage(const Results& results) {
    Page page;
    page.add(fmt::format("<!doctype html>\n<html lang='en'><head><meta charset='utf-8'><title>Brume: "
                         "benchmark</title>\n<style>{}</style></head>\n<body>\n",
                         kStyle));
    addSummary(results, page);
    page.add(makeRowTable(results.frames));
    for (const Findings& findings : results.findings) {
        page.add(fmt::format("<h2>{}: {}</h2>\n", escapeHtml(findings.suite),
                             escapeHtml(findings.summary)));
        for (const Table& table : findings.tables) page.add(table);
        for (const Plot& plot : findings.plots)
            page.add("<h3>" + escapeHtml(plot.title) + "</h3>\n" + drawPlot(plot));
    }
    addGroups(results.frames, page);
    page.add(makePassTable(results.frames));
    page.add(makeCommandTable(results));
    page.add(fmt::format("<script>{}</script>\n</body></html>\n", kScript));
    return page.take();
}

}  // namespace brume::bench
