// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "ism/config.hpp"

namespace ism::detail {

/// How reports look (CSS): one column, light or dark; tables scroll sideways on a phone.
inline constexpr std::string_view report_style = R"(
:root { color-scheme: light dark; --ink: #24252b; --soft: #5d606d; --page: #f3f3f6; --card: #fff; --inner: #f8f8fb;
  --line: #dcdce4; --link: #0a5fb4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e6ea; --soft: #a3a6b3; --page: #141519; --card: #1d1e24;
  --inner: #23252c; --line: #363843; --link: #7db8f5; } }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--page); margin: 0; }
main { max-width: 1100px; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0 1rem; overflow-wrap: anywhere; }
h2, h3, h4 { line-height: 1.25; margin: 0 0 .6rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; } h3 { font-size: 1.05rem; } h4 { font-size: 1rem; }
a { color: var(--link); text-decoration: none; }
summary > h2, summary > h3, summary > h4 { display: inline; }
details[open] > summary { margin-bottom: .6rem; }
summary { cursor: pointer; }
section, details, dl { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 1rem;
  margin: 0 0 1rem; }
section section, section details, details section, details details { background: var(--inner); }
section section section, section section details { background: var(--card); }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); gap: .8rem; }
dt { color: var(--soft); font-size: .85rem; }
dd { margin: 0; font-size: 1.1rem; font-weight: 600; overflow-wrap: anywhere; }
.legend { display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; list-style: none; padding: 0; margin: 0 0 .6rem; }
.legend li { overflow-wrap: anywhere; }
.legend i { display: inline-block; width: 1.5rem; height: .8rem; margin-right: .4rem; vertical-align: -.05rem;
  border: 2px solid var(--c); border-radius: 2px; background: color-mix(in srgb, var(--c) 35%, transparent); }
.legend i.dashed { border-color: #333; background: #333; outline: 2px dashed var(--c); outline-offset: -3px; }
.layers label { margin-left: .7rem; white-space: nowrap; }
.wide { display: inline-block; vertical-align: top; max-width: 100%; overflow-x: auto; margin: 0 2rem 1rem 0; }
table { border-collapse: collapse; font-size: .93rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; overflow-wrap: anywhere; }
th, td { padding: .25rem .7rem; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th.text, td.text { text-align: left; white-space: normal; overflow-wrap: anywhere; min-width: 6rem; max-width: 26rem; }
th:first-child, td:first-child { padding-left: 0; }
th { font-weight: 600; white-space: normal; vertical-align: bottom; }
figure { margin: 0 0 1rem; max-width: 100%; }
figcaption { color: var(--soft); font-size: .9rem; line-height: 1.35; margin-top: .3rem; overflow-wrap: anywhere; }
.gallery { display: flex; flex-wrap: wrap; gap: 0 1rem; align-items: flex-start; }
svg { max-width: 100%; height: auto; }
.pictures { position: absolute; width: 0; height: 0; }
.pic { position: relative; }
.pic svg { display: block; width: 100%; border-radius: 4px; background: #8886; }
.pic.bare svg { background: none; border: 1px solid var(--line); }
.pic svg * { vector-effect: non-scaling-stroke; }
.label { position: absolute; font-size: .8rem; line-height: 1.25rem; padding: 0 .3rem; border-radius: 3px;
  max-width: 100%; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.label.above { transform: translateY(-100%); }
.truth { fill: none; stroke: #fff; stroke-width: 2; stroke-dasharray: 6 4; }
.ignored { stroke: #a0a0a0; }
.under { stroke: #000; stroke-opacity: .65; stroke-width: 4; stroke-dasharray: none; }
.plot, .matrix { fill: var(--ink); }
.plot > rect { fill: none; }
.plot > line[stroke="#e4e4ea"] { stroke: var(--line); }
.plot > path { stroke: var(--soft); }
p { margin: 0 0 .8rem; overflow-wrap: anywhere; }
@media (max-width: 600px) { main { padding: .6rem; } section, details, dl { padding: .7rem; } .wide { margin-right: 0; } }
@media (max-width: 400px) { section section, section details { padding: .6rem .5rem; } }
)";

}  // namespace ism::detail
