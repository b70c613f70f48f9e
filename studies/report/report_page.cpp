#include "studies/report/report_page.h"

namespace hookpoint::studies {

std::string html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

namespace {

std::string_view report_style() {
  return R"(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1c1c1c; --soft: #666666; --rule: #d9d9d9; --band: #f6f6f4;
  --good: #00734f; --bad: #b3261e; --bad-band: #fbeceb; --link: #005a96; }
@media (prefers-color-scheme: dark) { :root { --paper: #16181a; --ink: #e6e6e3; --soft: #a0a09c; --rule: #3a3d40;
  --band: #1e2123; --good: #5cc9a0; --bad: #ff8a80; --bad-band: #3a2220; --link: #7cc0f0; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 Charter, "Bitstream Charter", "Iowan Old Style",
  Georgia, "Liberation Serif", serif; }
main { max-width: 1080px; margin: 0 auto; padding: 3rem 1.5rem 5rem; }
h1 { font-size: 2.1rem; line-height: 1.15; margin: 0 0 .6rem; font-weight: 600; }
h2 { font-size: 1.25rem; margin: 3rem 0 .6rem; padding-top: .8rem; border-top: 1px solid var(--rule); font-weight: 600; }
p, ul { max-width: 44rem; margin: .5rem 0; }
ul { padding-left: 1.2rem; }
a { color: var(--link); } td a { color: inherit; text-decoration: none; } td a:hover { text-decoration: underline; } tr:target { background: var(--band); outline: 1px solid var(--soft); }
.kicker, .facts, table, label, select, input, output, .note, figcaption, svg text { font-family: "Helvetica Neue", Helvetica, Arial,
  "Liberation Sans", sans-serif; }
.kicker { color: var(--soft); font-size: .85rem; margin: 0 0 .3rem; }
.question { font-size: 1.15rem; max-width: 44rem; }
.verdict { font-size: 1.15rem; font-weight: 600; margin: 1.4rem 0 .2rem; } .verdict + .verdict { margin-top: .2rem; }
.facts { color: var(--soft); font-size: .9rem; margin: .2rem 0; }
.good { color: var(--good); } .bad { color: var(--bad); } .soft { color: var(--soft); }
pre { background: var(--band); padding: .7rem .9rem; overflow-x: auto; font-size: .88rem; max-width: 44rem; margin: .6rem 0; }
.scroll { overflow-x: auto; margin: .8rem 0; }
table { border-collapse: collapse; font-size: .82rem; line-height: 1.35; font-variant-numeric: tabular-nums lining-nums; }
th, td { padding: .28rem .5rem; text-align: right; vertical-align: top; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
thead th { border-bottom: 1px solid var(--ink); }
thead tr.groups th { border-bottom: none; text-align: left; padding-bottom: 0; }
thead tr.units th { font-weight: 400; color: var(--soft); }
th.text, td.text { text-align: left; }
tbody tr { border-bottom: 1px solid var(--rule); }
tbody tr:hover { background: var(--band); }
table.summary tbody th { font-weight: 400; text-align: left; position: sticky; left: 0; background: var(--paper); }
table.summary .first, table.runs .first { padding-left: 1.1rem; }
small { display: block; font-size: .74rem; color: var(--soft); }
.note { font-size: .82rem; }
td.status { white-space: normal; text-align: left; min-width: 10rem; max-width: 22rem; }
.swatch { display: inline-block; width: 1.15rem; }
td.fails { background: var(--bad-band); }
figure { margin: 1.8rem 0 2.6rem; break-inside: avoid; }
figure svg { display: block; width: 100%; max-width: 900px; height: auto; }
figcaption { font-size: .86rem; max-width: 900px; color: var(--soft); margin-top: .4rem; }
figcaption b { color: var(--ink); }
.filter { display: flex; gap: 1rem; align-items: center; flex-wrap: wrap; font-size: .88rem; margin: .8rem 0; }
.filter input, .filter select { font-size: .88rem; padding: .25rem .45rem; color: var(--ink); background: var(--paper);
  border: 1px solid var(--soft); border-radius: 3px; }
table.runs { font-size: .76rem; }
table.runs th[data-sorts] { cursor: pointer; } th[data-sorts=up]::after { content: " ▲"; } th[data-sorts=down]::after { content: " ▼"; }
table.runs th, table.runs td { padding: .18rem .55rem; }
.tall { max-height: 75vh; overflow: auto; border-bottom: 1px solid var(--rule); }
.tall thead th { position: sticky; top: 0; background: var(--paper); }
table.distances { font-size: .74rem; } table.distances th, table.distances td { padding: .22rem .38rem; }
table.wide td { white-space: normal; text-align: left; max-width: 34rem; overflow-wrap: anywhere; }
@media print {
  :root { --paper: #fff; --ink: #000; --soft: #555; --rule: #ccc; --band: #f4f4f4; --good: #005a3c; --bad: #a00; --bad-band: #fbeceb; }
  html { font-size: 11px; } body { font-size: 10pt; } main { max-width: none; padding: 0; } table.summary small { font-size: 5.5pt; }
  .filter { display: none; } .scroll, .tall { overflow: visible; max-height: none; } thead { display: table-header-group; } a { color: inherit; }
  table { font-size: 7pt; } table.summary { font-size: 6.5pt; } table.runs { font-size: 6pt; } th, td { padding: 1pt 4pt; } tr { break-inside: avoid; } h2 { break-after: avoid; }
}
)";
}

std::string_view report_script() {
  return R"(
(function () {
  var table = document.querySelector('table.runs');
  if (!table) return;
  var body = table.tBodies[0], rows = Array.prototype.slice.call(body.rows);
  var bar = document.querySelector('.filter');
  bar.hidden = false;
  var words = bar.querySelector('input'), shown = bar.querySelector('output');
  var choices = Array.prototype.slice.call(bar.querySelectorAll('select'));
  function apply() {
    var wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean), count = 0;
    rows.forEach(function (row) {
      var text = row.textContent.toLowerCase();
      var fits = wanted.every(function (word) { return text.indexOf(word) >= 0; }) &&
        choices.every(function (choice) {
          return choice.value === '' || row.dataset[choice.name].split(' ').indexOf(choice.value) >= 0;
        });
      row.hidden = !fits;
      if (fits) count++;
    });
    shown.textContent = count + ' of ' + rows.length + ' rows';
  }
  function key(row, column) {
    var text = row.cells[column].textContent, number = parseFloat(text);
    return isNaN(number) ? text : number;
  }
  table.querySelectorAll('th[data-sorts]').forEach(function (head) {
    head.addEventListener('click', function () {
      var column = head.cellIndex, sign = head.dataset.sorts === 'up' ? -1 : 1;
      table.querySelectorAll('th[data-sorts]').forEach(function (other) {
        if (other !== head) { other.dataset.sorts = ''; other.removeAttribute('aria-sort'); }
      });
      head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      head.dataset.sorts = sign > 0 ? 'up' : 'down';
      rows.sort(function (a, b) {
        var x = key(a, column), y = key(b, column);
        if (typeof x !== typeof y) return typeof x === 'number' ? -1 : 1;
        return x < y ? -sign : x > y ? sign : 0;
      });
      rows.forEach(function (row) { body.appendChild(row); });
    });
  });
  words.addEventListener('input', apply);
  choices.forEach(function (choice) { choice.addEventListener('change', apply); });
  document.querySelectorAll('[data-shows]').forEach(function (link) {
    link.addEventListener('click', function () {
      var shows = JSON.parse(link.dataset.shows);
      words.value = '';
      choices.forEach(function (choice) { choice.value = shows[choice.name] || ''; });
      apply();
    });
  });
  apply();
})();
)";
}

}  // namespace

std::string page_start(const std::string& title, std::string_view more_style) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      html(title) + " - hookpoint</title>\n<style>";
  page += report_style();
  page += more_style;
  return page + "</style>\n</head>\n<body>\n<main>\n";
}

std::string page_end_with_script() {
  std::string page = "</main>\n<script>";
  page += report_script();
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace hookpoint::studies
