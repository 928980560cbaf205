#pragma once
// The texts of a page: title, captions, keys of charts, tables, lines. What `below_...` draws is at the top of `place`;
// it returns what is left below.

#include "postproc/page/paper.h"
#include "postproc/page/report_page.h"

namespace pfdm {

Rectangle below_title(Paper& paper, const Rectangle& place, const std::string& title, const std::string& subtitle);
Rectangle below_caption(Paper& paper, const Rectangle& place, const std::string& caption);
/// Which series is which.
Rectangle below_key(Paper& paper, const Rectangle& place, const Chart& chart);

double table_height(const Table& table, double width);  ///< [pt]
/// The last column is broken into lines where it is too long; other texts are made smaller.
void draw_table(Paper& paper, const Rectangle& place, const Table& table);

double text_height(const TextBlock& text, double width);  ///< [pt]
void draw_text(Paper& paper, const Rectangle& place, const TextBlock& text);

}  // namespace pfdm
