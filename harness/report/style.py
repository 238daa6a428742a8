"""The look of the reports: colours, on light and on dark ground, and CSS."""

from __future__ import annotations

#: Colours that stay apart for colour-blind eyes (Okabe and Ito, "Color Universal Design", 2008).
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#444444")

#: Marks impacts in every chart.
IMPACT_COLOUR = "#B3261E"

#: What has no colour of its own.
WHEEL = "#c9d2dc"

#: The same in a page, whose style says what they are on light and on dark ground.
THEMED = {colour: f"var(--c{k})" for k, colour in enumerate(COLOURS, start=1)} | {
    IMPACT_COLOUR: "var(--hit)",
    WHEEL: "var(--wheel)",
}

FONT = "Inter, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"

CSS = f"""
:root {{ color-scheme: light dark; --ink: #1c2733; --soft: #5b6875; --line: #dfe5ea; --ground: #f5f7f9; --card: #fff;
  --wheel: #c9d2dc; --hit: #B3261E; --good: #1b7f4b; --changed: #fff8e6; --trouble: #fdecea; --shade: #1c273338;
  --c1: #0072B2; --c2: #B84F00; --c3: #007F5C; --c4: #B0568A; --c5: #946500; --c6: #2779A7; --c7: #444444; }}
@media (prefers-color-scheme: dark) {{ :root {{ --ink: #e6ebf0; --soft: #a3b0bd; --line: #33404d; --ground: #11171d;
  --card: #1a222b; --wheel: #46535f; --hit: #ff7a70; --good: #4cc38a; --changed: #3a3216; --trouble: #3c1f1d;
  --shade: #000a; --c1: #56B4E9; --c2: #ff8a3d; --c3: #2fc69a; --c4: #e39cc4; --c5: #E69F00; --c6: #9bd0f0;
  --c7: #b8c0c8; }} }}
* {{ box-sizing: border-box; }}
[hidden] {{ display: none !important; }}
body {{ margin: 0; font: 15px/1.5 {FONT}; color: var(--ink); background: var(--ground); }}
main {{ max-width: 1180px; margin: 0 auto; padding: 28px 24px 60px; }}
header h1 {{ margin: 0; font-size: 28px; letter-spacing: -0.01em; }}
header p {{ margin: 4px 0 0; color: var(--soft); overflow-wrap: anywhere; }}
section {{ background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 18px 20px;
  margin-top: 18px; }}
h2 {{ margin: 0 0 4px; font-size: 18px; }}
section > p, section > details > p {{ margin: 0 0 10px; color: var(--soft); overflow-wrap: anywhere; }}
summary {{ cursor: pointer; }}
summary h2 {{ display: inline; }}
section > details > summary + * {{ margin-top: 4px; }}
nav {{ margin-top: 18px; }}
nav details {{ max-height: 40vh; overflow-y: auto; }}
nav ul {{ columns: 15em; list-style: none; margin: 6px 0 0; padding: 0; }}
nav a {{ color: inherit; overflow-wrap: anywhere; }}
.unpacking {{ margin: 18px 0 0; color: var(--soft); }}
.cards {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); gap: 14px; margin-top: 18px; }}
.card {{ background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 12px 16px; }}
.card b {{ display: block; font-size: 22px; font-weight: 650; letter-spacing: -0.01em;
  overflow-wrap: anywhere; }}
.card span {{ color: var(--soft); font-size: 13px; overflow-wrap: anywhere; }}
ul.points {{ margin: 0; padding-left: 20px; }}
ul.points li {{ overflow-wrap: anywhere; padding: 2px 0; }}
ul.checks {{ list-style: none; margin: 0; padding: 0; }}
ul.checks li {{ padding: 5px 0 5px 30px; position: relative; }}
ul.checks li::before {{ position: absolute; left: 0; width: 20px; height: 20px; border-radius: 50%; color: var(--card);
  font-size: 13px; line-height: 20px; text-align: center; top: 7px; }}
ul.checks li.good::before {{ content: "✓"; background: var(--good); }}
ul.checks li.bad::before {{ content: "✕"; background: var(--hit); }}
ul.checks small {{ color: var(--soft); font-size: 13px; margin-left: 6px; }}
.scroll {{ overflow-x: auto; }}
/* a shadow at the lower edge says that there is more; at the end, what moves with the rows covers it */
.tall {{ max-height: min(70vh, 620px); overflow-y: auto; background:
  linear-gradient(transparent, var(--card) 60%) bottom / 100% 40px no-repeat local,
  linear-gradient(transparent, var(--shade)) bottom / 100% 16px no-repeat scroll; }}
.tall th {{ position: sticky; top: 0; background: var(--card); }}
.charts {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 10px 24px; }}
.charts.stacked {{ grid-template-columns: minmax(0, 1fr); }}
.charts.small {{ grid-template-columns: repeat(auto-fit, minmax(min(100%, 280px), 1fr)); }}
.charts > *, .chart, .plot {{ min-width: 0; }}
.plot {{ margin: 6px 0 10px; }}
.plot figcaption {{ display: flex; flex-wrap: wrap; align-items: baseline; gap: 0 12px; min-height: 26px; }}
.plot figcaption span {{ color: var(--soft); font-size: 13px; }}
.plot .at {{ margin-left: auto; font-size: 13px; color: var(--soft); font-variant-numeric: tabular-nums; }}
.plot button {{ font: inherit; font-size: 12px; padding: 0 6px; border: 1px solid transparent; border-radius: 5px;
  background: none; color: var(--soft); cursor: pointer; }}
.plot figcaption button {{ border-color: var(--line); }}
.plot > svg {{ display: block; width: 100%; touch-action: pan-y; cursor: crosshair; }}
.plot.still > svg {{ display: none; }}
.plot text {{ font-size: 12px; fill: var(--soft); }}
.plot text.own {{ font-weight: 650; }}
.plot path:not(.area) {{ fill: none; }}
.plot .grid {{ stroke: var(--line); }}
.plot .axis {{ stroke: var(--soft); }}
.plot .curve {{ stroke-width: 1.8; stroke-linejoin: round; }}
.plot .kept {{ stroke-dasharray: 6 4; opacity: 0.6; }}
.plot .dots {{ stroke-width: 6; stroke-linecap: round; opacity: 0.75; }}
.plot .area {{ fill-opacity: 0.2; }}
.plot .struck {{ stroke: var(--hit); stroke-dasharray: 2 3; opacity: 0.6; }}
.plot .sticks {{ stroke: var(--ink); stroke-dasharray: 2 4; opacity: 0.75; }}
.plot .cursor {{ stroke: var(--ink); pointer-events: none; }}
.plot .chosen {{ fill: var(--c1); fill-opacity: 0.25; pointer-events: none; }}
.plot .grip {{ fill: transparent; cursor: ns-resize; touch-action: none; }}
.plot .curves {{ list-style: none; display: flex; flex-wrap: wrap; gap: 0 10px; margin: 2px 0 0; padding: 0; }}
.plot .curves button {{ text-align: left; }}
.plot .curves button[aria-pressed=false] {{ text-decoration: line-through; }}
.plot .curves button[aria-pressed=false] i {{ visibility: hidden; }}
.plot .curves i {{ display: inline-block; width: 14px; height: 4px; margin-right: 6px; vertical-align: 3px; }}
.plot .curves b {{ color: var(--ink); font-variant-numeric: tabular-nums; display: inline-block; min-width: 4.5em; }}
.parallel .stack {{ position: relative; }}
.parallel canvas {{ display: block; }}
.parallel .stack svg {{ position: absolute; left: 0; top: 0; width: auto; }}
.live-page iframe {{ display: block; width: 100%; height: min(88vh, 940px); border: 1px solid var(--line);
  border-radius: 8px; background: var(--ground); margin-bottom: 8px; }}
.live-page button {{ font: inherit; padding: 4px 12px; border: 1px solid var(--soft); border-radius: 6px;
  background: var(--card); color: inherit; cursor: pointer; }}
.scroll > .statechart {{ background: #fff; border-radius: 8px; color-scheme: light; }}
:focus-visible {{ outline: 3px solid var(--c1); outline-offset: 1px; }}
table {{ border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }}
th, td {{ padding: 6px 12px 6px 0; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }}
td {{ white-space: nowrap; }}
td.long {{ white-space: normal; min-width: min(24em, 72vw); }}
th {{ color: var(--soft); font-weight: 600; border-bottom-width: 2px; }}
td.number, th.number {{ text-align: right; padding-right: 14px; }}
th.number {{ vertical-align: bottom; }}
tr.changed td {{ background: var(--changed); }}
code {{ font: 13px ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; }}
.banner {{ background: var(--trouble); border-color: var(--hit); }}
.animation svg {{ display: block; width: 100%; max-height: 560px; background: var(--card); border-radius: 8px; }}
.animation .panels {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 190px), 1fr));
  gap: 14px; }}
.animation figure {{ margin: 0; min-width: 0; }}
.animation .panels svg {{ height: 230px; }}
.animation .panels svg.hit {{ box-shadow: inset 0 0 0 2px var(--hit); }}
.animation figcaption {{ font-weight: 600; margin-top: 6px; }}
.animation .panels .legend {{ margin: 4px 0 6px; font-size: 12px; }}
.animation ul {{ list-style: none; display: flex; flex-wrap: wrap; gap: 4px 14px; margin: 0; padding: 0; }}
.animation .legend {{ display: flex; flex-wrap: wrap; justify-content: space-between; gap: 6px 28px;
  margin: 10px 0; font-size: 13px; color: var(--soft); }}
.animation .legend i {{ display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 6px;
  vertical-align: -1px; }}
.animation .lamp {{ padding: 0 9px; border: 1px solid var(--line); border-radius: 9px; color: var(--soft); }}
.animation .lamp.lit {{ background: var(--lamp); border-color: var(--lamp); color: var(--card); font-weight: 600; }}
.animation .timeline {{ position: relative; }}
.animation input[type=range] {{ width: 100%; margin: 14px 0 8px; }}
.animation .marks {{ position: absolute; left: 8px; right: 8px; top: 0; height: 14px; pointer-events: none; }}
.animation .marks i {{ position: absolute; width: 2px; height: 9px; margin-left: -1px; top: 4px; opacity: 0.75; }}
.animation .marks i.now {{ width: 8px; height: 14px; margin-left: -4px; top: 0; border-radius: 3px; opacity: 1; }}
.animation .controls {{ display: flex; flex-wrap: wrap; align-items: center; gap: 8px 14px; }}
.animation button, .animation select {{ font: inherit; padding: 4px 12px; border: 1px solid var(--soft);
  border-radius: 6px; background: var(--card); color: inherit; cursor: pointer; }}
.animation .play {{ min-width: 76px; }}
.animation .time {{ font-weight: 650; font-variant-numeric: tabular-nums; min-width: 8em; }}
.animation .struck {{ color: var(--hit); font-variant-numeric: tabular-nums; }}
@media (max-width: 640px) {{
  .plot .curves b {{ min-width: 0; }}
  main {{ padding: 16px 10px 40px; }}
  section {{ padding: 14px 12px; }}
  .parameters table, .parameters tbody {{ display: block; }}
  .parameters thead {{ display: none; }}
  .parameters tr {{ display: grid; grid-template: "name value unit" "meaning meaning origin" / auto 1fr auto;
    gap: 0 6px; padding: 6px 0; border-bottom: 1px solid var(--line); }}
  .parameters tr.changed {{ background: var(--changed); }}
  .parameters td, .facts td {{ white-space: normal; overflow-wrap: anywhere; }}
  .parameters td, .parameters td.number {{ border: 0; padding: 0; }}
  .parameters td.long, .facts td.long {{ min-width: 0; }}
  .facts td:first-child {{ width: 40%; }}
  .parameters td:nth-child(3) {{ grid-area: unit; }}
  .parameters td:nth-child(4) {{ grid-area: origin; text-align: right; }}
  .parameters td:nth-child(5) {{ grid-area: meaning; }}
  .parameters td:nth-child(n + 4) {{ font-size: 13px; color: var(--soft); }}
  .animation .panels {{ grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; }}
  .animation .panels svg {{ height: 170px; }}
  .cards {{ grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; }}
  .card b {{ font-size: 18px; }}
  ul.checks small {{ display: block; margin-left: 0; }}
  .scroll .statechart {{ max-width: none !important; }}
}}
@media print {{ body {{ background: #fff; }} .plot figcaption button {{ display: none; }}
  section, .card {{ break-inside: avoid; }}
  .tall {{ max-height: none; }} }}
"""


def themed(text: str) -> str:
    """A text, such as the data of a picture, with colours that the page's style knows."""
    for colour, instead in THEMED.items():
        text = text.replace(colour, instead)
    return text
