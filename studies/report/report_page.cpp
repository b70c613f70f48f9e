#include "studies/report/report_page.h"

#include "studies/report/page_files.h"

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

std::string page_start(const std::string& title, std::string_view more_style) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      html(title) + " - hookpoint</title>\n<style>\n";
  page += page_files::report_css;
  page += more_style;
  return page + "</style>\n</head>\n<body>\n<main>\n";
}

std::string page_end_with_script() {
  std::string page = "</main>\n<script>\n";
  page += page_files::report_js;
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace hookpoint::studies
