"""How a report looks: on A4, on a screen and on a telephone. Light, whatever the system prefers: it is handed on."""

PAGE = """
@page { size: A4; margin: 9mm 13mm; }
html { background: #eef1f4; color-scheme: light; }
body { margin: 0; }
@media print { html { background: none; } }
"""

STYLE = """
.strikewave-report { --size: 8.4pt; box-sizing: border-box; max-width: 210mm; margin: 0 auto; padding: 9mm 13mm;
  background: #fff; color: #1d2733; 
  font: var(--size)/1.36 "Helvetica Neue", Helvetica, Arial, "Liberation Sans", sans-serif;
  print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.strikewave-report.dense { --size: 7.7pt; line-height: 1.3; }
.strikewave-report.denser { --size: 6.9pt; line-height: 1.25; }
.strikewave-report.densest { --size: 6.3pt; line-height: 1.22; }
.strikewave-report * { box-sizing: border-box; }
.strikewave-report header { border-bottom: 1.6pt solid #0c3a78; margin-bottom: .8em; padding-bottom: .5em; }
.strikewave-report .kind { display: flex; justify-content: space-between; gap: 1em; margin: 0; color: #0c3a78;
  font-size: .88em; letter-spacing: .03em; }
.strikewave-report h1 { font-size: 1.75em; line-height: 1.15; margin: .15em 0 .2em; font-weight: 650; color: #10223a;
  overflow-wrap: anywhere; }
.strikewave-report h2 { font-size: 1.06em; margin: 0 0 .3em; color: #0c3a78; font-weight: 650; }
.strikewave-report p { margin: 0 0 .35em; }
.strikewave-report .about { color: #4a5563; margin: 0; overflow-wrap: anywhere; }
.strikewave-report section { margin-bottom: .8em; min-width: 0; }
.strikewave-report .two { display: grid; grid-template-columns: 1.6fr 1fr; gap: 0 1.6em; }
.strikewave-report .two.even { grid-template-columns: 1fr 1fr; }
.strikewave-report table { border-collapse: collapse; width: 100%; background: none; color: inherit;
  font-size: 1em; margin: 0; }
.strikewave-report tr { background: none; }
.strikewave-report th, .strikewave-report td { text-align: left; vertical-align: baseline; padding: .09em .7em .09em 0;
  font-weight: 400; white-space: normal; overflow-wrap: break-word; border: 0; }
.strikewave-report thead th { color: #5b6775; font-size: .9em; border-bottom: .6pt solid #9aa6b4; }
.strikewave-report tbody tr + tr > * { border-top: .4pt solid #e2e6ea; }
.strikewave-report .part th { font-weight: 650; padding-top: .25em; }
.strikewave-report .key, .strikewave-report code {
  font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: .86em; }
.strikewave-report .key { color: #3d4a59; overflow-wrap: normal; }
.strikewave-report .number, .strikewave-report .numbers td { white-space: nowrap; overflow-wrap: normal; }
.strikewave-report .follows { color: #6a7685; font-style: italic; }
.strikewave-report .tolerance { color: #a04310; font-weight: 600; }
.strikewave-report .numbers th[scope=row] { font-weight: 600; }
.strikewave-report .number { font-variant-numeric: tabular-nums; font-weight: 600; }
.strikewave-report .small { font-size: .86em; color: #5b6775; margin: .3em 0 0; }
.strikewave-report figure { margin: 0; min-width: 0; }
.strikewave-report .picture figure { text-align: center; }
.strikewave-report .picture img { max-width: 100%; max-height: 70mm; }
.strikewave-report.dense .picture img { max-height: 62mm; }
.strikewave-report.denser .picture img { max-height: 58mm; }
.strikewave-report.densest .picture img { max-height: 55mm; }
.strikewave-report .reaches td { white-space: normal; overflow-wrap: anywhere; }
.strikewave-report small { font-size: .86em; color: #5b6775; }
.strikewave-report svg { display: block; width: 100%; height: auto; }
.strikewave-report.dense .even svg { max-height: 45mm; }
.strikewave-report.denser .even svg { max-height: 39mm; }
.strikewave-report.densest .even svg { max-height: 35mm; }
.strikewave-report dl { display: grid; grid-template-columns: max-content 1fr; gap: .15em .9em; margin: 0 0 .4em; }
.strikewave-report dt { color: #5b6775; }
.strikewave-report dd { margin: 0; min-width: 0; overflow-wrap: anywhere; }
.strikewave-report dd code { white-space: pre-wrap; }
.strikewave-report ul { list-style: none; margin: 0; padding: 0; }
.strikewave-report li { border-left: 2.4pt solid #9aa6b4; padding: .05em 0 .05em .7em; margin-bottom: .3em;
  overflow-wrap: anywhere; }
.strikewave-report li.warning { border-color: #d98a00; }
.strikewave-report li.warning b { color: #8a5600; }
.strikewave-report li.invalid { border-color: #b3131b; }
.strikewave-report li.invalid b, .strikewave-report p.invalid { color: #b3131b; font-weight: 650; }
.strikewave-report footer { border-top: .8pt solid #9aa6b4; padding-top: .6em; }
.strikewave-report footer dl { grid-template-columns: 5.5em 1fr; }
.strikewave-report a { color: #0c3a78; }
@media print { .strikewave-report { max-width: none; padding: 0; } }
@media screen and (max-width: 700px) {
  .strikewave-report { --size: 10.5pt; padding: 5mm 4.5mm; }
  .strikewave-report[class] { --size: 10.5pt; line-height: 1.36; }
  .strikewave-report .two, .strikewave-report .two.even, .strikewave-report footer dl { grid-template-columns: 1fr; }
  .strikewave-report .even svg { max-height: none !important; margin-bottom: .6em; }
  .strikewave-report thead { display: none; }
  .strikewave-report tbody tr { display: grid; grid-template-columns: 2fr 3fr; padding: .15em 0; }
  .strikewave-report tbody tr > * { border: 0 !important; }
  .strikewave-report tbody tr + tr { border-top: .4pt solid #e2e6ea; }
  .strikewave-report .part { display: block !important; }
  .strikewave-report .inputs tr > :nth-child(2) { order: 3; }
  .strikewave-report .numbers tr > th { grid-row: span 2; }
  .strikewave-report .numbers td { white-space: normal; }
  .strikewave-report .reaches tr > th { grid-row: span 3; }
  .strikewave-report .reaches td[data-head]::before { content: attr(data-head) " "; color: #5b6775; }
  .strikewave-report .picture img { max-height: none; }
}
"""
