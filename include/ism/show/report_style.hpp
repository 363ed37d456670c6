// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "ism/config.hpp"

namespace ism::detail {

/// How reports look (CSS): one light column, tables and rows of images scroll sideways on a phone.
inline constexpr std::string_view report_style = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #24252b; background: #f4f4f7; margin: 0; }
main { max-width: 1100px; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0 1rem; }
h2, h3, h4 { line-height: 1.25; margin: 0 0 .6rem; }
h2 { font-size: 1.25rem; } h3 { font-size: 1.05rem; } h4 { font-size: 1rem; }
summary > h2, summary > h3, summary > h4 { display: inline; }
details[open] > summary { margin-bottom: .6rem; }
summary { cursor: pointer; }
section, details, dl { background: #fff; border: 1px solid #e2e2e9; border-radius: 10px; padding: 1rem; margin: 0 0 1rem; }
section section, section details, details section, details details { background: #fafafc; }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); gap: .8rem; }
dt { color: #686b78; font-size: .85rem; }
dd { margin: 0; font-size: 1.1rem; font-weight: 600; overflow-wrap: anywhere; }
.wide { display: inline-block; vertical-align: top; max-width: 100%; overflow-x: auto; margin: 0 2rem 1rem 0; }
table { border-collapse: collapse; font-size: .93rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: #686b78; padding-bottom: .3rem; }
th, td { padding: .25rem .7rem; text-align: right; border-bottom: 1px solid #e8e8ee; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
th { font-weight: 600; border-bottom-color: #b9bac4; }
figure { margin: 0 0 1rem; }
figure img { max-width: 100%; height: auto; display: block; border-radius: 4px; }
figcaption { color: #686b78; font-size: .9rem; margin-top: .3rem; }
svg { max-width: 100%; height: auto; }
p { margin: 0 0 .8rem; }
@media (max-width: 600px) {
  main { padding: .6rem; } section, details, dl { padding: .7rem; }
  figure.row { overflow-x: auto; } figure.row img { max-width: none; width: 900px; }
}
)";

}  // namespace ism::detail
