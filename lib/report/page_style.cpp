#include "report/html_report.h"

namespace pigment::report {

const char* const page_style = R"css(
:root{color-scheme:light dark;--page:#fbfbfa;--card:#fff;--ink:#1d2530;--soft:#5b6675;--faint:#8a94a3;--rule:#e2e5ea;--grid:#eceef2;
  --accent:#1f5fae;--mark:#b3541e;--tip:#ffffffee;--shade:0 1px 2px #1a273814,0 4px 14px #1a27380d}
@media screen and (prefers-color-scheme:dark){:root{--page:#12161c;--card:#1a2029;--ink:#e6eaf0;--soft:#a3aebd;--faint:#758195;
  --rule:#2c3541;--grid:#252d38;--accent:#7fb2f0;--mark:#f0a26b;--tip:#232b36ee;--shade:0 1px 2px #0006}}
*{box-sizing:border-box}
html{scroll-behavior:smooth;scroll-padding-top:3.4rem}
body{margin:0;background:var(--page);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",sans-serif}
header,main{max-width:1240px;margin:0 auto;padding:0 1.5rem}
header{padding-top:2.6rem;padding-bottom:1rem}
h1{margin:0;font-size:1.95rem;font-weight:650;letter-spacing:-.015em;line-height:1.2}
header p{margin:.4rem 0 0;color:var(--soft);font-size:1.02rem}
nav{position:sticky;top:0;z-index:5;background:color-mix(in srgb,var(--page) 88%,transparent);backdrop-filter:blur(8px);
  border-bottom:1px solid var(--rule);display:flex;gap:.2rem 1.15rem;overflow-x:auto;white-space:nowrap;
  padding:.6rem max(1.5rem,calc((100vw - 1240px)/2 + 1.5rem));scrollbar-width:none}
nav a{color:var(--soft);text-decoration:none;font-size:.92rem}
nav a:hover,nav a:focus-visible{color:var(--accent)}
main{padding-bottom:4rem}
section{margin-top:2.4rem}
h2{font-size:1.28rem;font-weight:620;letter-spacing:-.008em;margin:0 0 .5rem}
h2.chapter{font-size:1.55rem;margin-top:3rem;padding-top:1.2rem;border-top:2px solid var(--rule)}
section>p{margin:.2rem 0 1rem;color:var(--soft);max-width:78ch}
.headlines{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:.8rem;margin:1.1rem 0 0}
.headlines>div{background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:.8rem 1rem .75rem;box-shadow:var(--shade)}
dt{color:var(--soft);font-size:.84rem}
dd{margin:.1rem 0 0;font-size:1rem;color:var(--soft)}
dd b{font-size:1.5rem;font-weight:620;color:var(--ink);letter-spacing:-.01em;font-variant-numeric:tabular-nums}
dd.note{font-size:.8rem;color:var(--faint);line-height:1.35}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,500px),1fr));gap:1.1rem;margin-top:1rem}
figure{margin:0}
figure.plot{background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:.9rem 1rem .7rem;box-shadow:var(--shade);min-width:0}
figure.plot figcaption{font-weight:600;font-size:.98rem}
.legend{display:flex;flex-wrap:wrap;gap:.1rem .9rem;margin:.3rem 0 .1rem}
.key{all:unset;cursor:pointer;font-size:.84rem;color:var(--soft);display:inline-flex;align-items:center;gap:.4rem;line-height:1.6}
.key:focus-visible,svg:focus-visible{outline:2px solid var(--accent);outline-offset:2px;border-radius:4px}
.key i{width:1.15rem;height:3px;border-radius:2px;flex:none}
.key.dashed i{mask:repeating-linear-gradient(90deg,#000 0 5px,#0000 5px 8px);-webkit-mask:repeating-linear-gradient(90deg,#000 0 5px,#0000 5px 8px)}
.key[aria-pressed=false]{opacity:.4;text-decoration:line-through}
.canvas{position:relative}
svg{display:block;width:100%;height:auto;overflow:visible;touch-action:pan-y}
svg text{font-family:inherit;fill:var(--soft);font-size:12.5px;font-variant-numeric:tabular-nums}
svg .label{font-size:13px;fill:var(--ink)}
svg .grid{stroke:var(--grid);stroke-width:1;fill:none}
svg .axis{stroke:var(--faint);stroke-width:1;fill:none}
svg .line{fill:none;stroke:currentColor;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}
svg .dashed{stroke-dasharray:6 5}
svg .current .line{stroke-width:3}
svg .bar{fill:none;stroke:currentColor;stroke-width:1.3}
svg .dot{fill:none;stroke:currentColor;stroke-width:6.4;stroke-linecap:round}
.curves path{vector-effect:non-scaling-stroke}
svg .now{stroke:var(--accent);stroke-width:1.2;fill:none;opacity:.75;pointer-events:none}
svg .zoom-box{fill:var(--accent);fill-opacity:.12;stroke:var(--accent);pointer-events:none}
.unzoom{position:absolute;right:8px;top:4px;font:inherit;font-size:.78rem;color:var(--accent);background:var(--card);border:1px solid var(--rule);border-radius:6px;padding:.05rem .5rem;cursor:pointer}
.unzoom[hidden]{display:none}
header .hint{font-size:.86rem;color:var(--faint)}
svg .marker{stroke:var(--mark);stroke-width:1.2;stroke-dasharray:4 3;fill:none}
svg .marker-label{fill:var(--mark);font-size:12.5px;paint-order:stroke;stroke:var(--card);stroke-width:4px;stroke-linejoin:round}
svg .cross{stroke:var(--soft);stroke-width:1;fill:none;opacity:.7}
svg .pick{stroke:var(--card);stroke-width:1.5}
.off{display:none}
.tip{position:absolute;pointer-events:none;background:var(--tip);border:1px solid var(--rule);border-radius:7px;padding:.35rem .6rem;font-size:.8rem;
  line-height:1.45;box-shadow:var(--shade);white-space:nowrap;z-index:3;font-variant-numeric:tabular-nums}
.tip b{font-weight:600}
.tip span{display:flex;align-items:center;gap:.4rem;color:var(--soft)}
.tip span b{margin-left:auto;padding-left:.8rem;color:var(--ink)}
.tip i{width:.6rem;height:.6rem;border-radius:50%;flex:none}
.slider{display:flex;align-items:center;gap:.8rem;margin:.35rem .2rem .2rem 3.6rem;font-size:.86rem;color:var(--soft)}
.slider input{flex:1;accent-color:var(--accent);min-width:0}
.slider output{min-width:5.5em;text-align:right;color:var(--ink);font-variant-numeric:tabular-nums}
.note{margin:.35rem 0 0;font-size:.86rem;color:var(--soft);max-width:90ch}
.pictures{display:flex;gap:1rem;margin-top:1rem;overflow-x:auto}
.pictures figure{flex:1 1 0;min-width:150px;max-width:640px}
.pictures img{display:block;width:100%;height:auto;border-radius:8px;border:1px solid var(--rule)}
@media screen and (prefers-color-scheme:dark){.pictures img{filter:brightness(.93)}}
.colours{display:flex;flex-wrap:wrap;gap:.2rem 1.4rem;align-items:flex-start;margin:.8rem 0 0;font-size:.86rem;color:var(--soft)}
.colours .bar{width:min(320px,60vw);position:relative;padding-bottom:1.35rem}
.colours .bar i{display:block;height:.7rem;border-radius:3px}
.colours .bar span{position:absolute;top:.8rem;transform:translateX(-50%);font-size:.8rem;font-variant-numeric:tabular-nums}
.colours .tint{display:inline-flex;align-items:center;gap:.4rem}
.colours .tint i{width:.85rem;height:.85rem;border-radius:50%}
.pictures figcaption{font-size:.88rem;color:var(--soft);margin-top:.4rem;text-align:center}
.sheets{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,500px),1fr));gap:1.1rem;margin-top:1rem}
.sheets img{display:block;width:100%;height:auto;background:#fff;border:1px solid var(--rule);border-radius:10px;padding:.5rem}
.sheets .wide{grid-column:1/-1;max-width:980px}
.sheets figcaption{max-width:100ch;font-size:.88rem;color:var(--soft);margin-top:.4rem}
@media screen and (prefers-color-scheme:dark){.sheets img{filter:brightness(.93)}}
.claims td{min-width:11ch;line-height:1.45}
.claims td:nth-child(n+3){min-width:22ch}
.verdict{white-space:nowrap;border-radius:6px;padding:.1rem .5rem;font-size:.82rem;font-weight:600;border:1px solid currentColor;color:var(--soft)}
.verdict.reproduced{color:#2e7d4f}
.verdict.not-reproduced{color:var(--mark)}
@media screen and (prefers-color-scheme:dark){.verdict.reproduced{color:#7fcf9f}}
.scroll{overflow-x:auto}
table{border-collapse:collapse;font-size:.9rem;margin-top:.6rem;min-width:50%}
th,td{text-align:left;padding:.35rem 1.1rem .35rem 0;border-bottom:1px solid var(--rule);vertical-align:top;font-variant-numeric:tabular-nums}
th{color:var(--soft);font-weight:600;white-space:nowrap}
details{margin-top:.8rem;border:1px solid var(--rule);border-radius:8px;background:var(--card);padding:.1rem .9rem}
summary{cursor:pointer;padding:.45rem 0;font-size:.93rem}
pre{margin:.2rem 0 .8rem;overflow-x:auto;font:13px/1.5 ui-monospace,SFMono-Regular,Menlo,"DejaVu Sans Mono",monospace;color:var(--soft)}
.remark{border-left:3px solid var(--mark);padding:.3rem .9rem;color:var(--ink)!important}
@media (max-width:720px){.pictures{flex-wrap:wrap}.pictures figure{flex-basis:45%}}
@page{margin:14mm}
@media print{
  :root{color-scheme:light}
  body{font-size:10.5pt;background:#fff}
  nav,.slider,.tip,.unzoom,.hint,svg .now{display:none}
  header,main{max-width:none;padding:0}
  figure,.headlines>div,tr{break-inside:avoid;box-shadow:none!important}
  h2,section>p{break-after:avoid}
  svg text,svg .label,svg .marker-label{font-size:15px}
  .plots{grid-template-columns:1fr 1fr}
  *{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
)css";

}  // namespace pigment::report
