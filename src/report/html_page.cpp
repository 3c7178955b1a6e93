#include "report/html_page.h"

namespace gapscope::internal::report {
namespace {

/// Pictures are drawn on white: dark pages turn their lightness and keep their hues.
constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--ink:#1b1f24;--soft:#57606a;--paper:#fff;--line:#d0d7de;--card:#f3f6f9;--mark:#0b62a8}
@media(prefers-color-scheme:dark){:root{--ink:#e4e7eb;--soft:#a0a8b2;--paper:#15181c;--line:#3a424c;--card:#1f242b;--mark:#6cb2ee}
img{filter:invert(.91) hue-rotate(180deg)}}
*{box-sizing:border-box}
body{font:16px/1.5 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;color:var(--ink);background:var(--paper);max-width:62rem;margin:0 auto;padding:1.2rem}
h1{font-size:1.6rem;margin:.2rem 0 .8rem}
h3{font-size:1.05rem;margin:1.6rem 0 .4rem}
a{color:var(--mark)}
.card{list-style:none;margin:0 0 1rem;padding:.9rem 1.1rem;background:var(--card);border-left:4px solid var(--mark);border-radius:4px}
.card li{margin:.3rem 0;overflow-wrap:anywhere}
blockquote{margin:1rem 0;padding:.5rem 1rem;border-left:4px solid #d29922;background:var(--card)}
details{border-top:1px solid var(--line);padding:.5rem 0}
summary{cursor:pointer;font-weight:600;font-size:1.15rem}
.wide{overflow-x:auto}
table{border-collapse:collapse;margin:.8rem 0;font-size:.92rem}
th,td{text-align:left;vertical-align:top;padding:.3rem .6rem;border-bottom:1px solid var(--line)}
.short{white-space:nowrap}
.long{min-width:16rem}
th{cursor:pointer;color:var(--soft);vertical-align:bottom}
th[aria-sort=ascending]::after{content:" \2191"}
th[aria-sort=descending]::after{content:" \2193"}
tbody tr:hover{background:var(--card)}
code{font-family:ui-monospace,"DejaVu Sans Mono",monospace;font-size:.92em}
figure{margin:.6rem 0;overflow-x:auto}
img{display:block;width:100%;min-width:calc(var(--columns,1)*23rem);max-width:calc(var(--columns,1)*46rem);height:auto;background:#fff}
@media(max-width:30rem){body{padding:.7rem}.card{padding:.7rem .8rem}}
@media print{body{max-width:none;padding:0;font-size:11pt}figure,.card,tr{break-inside:avoid}h3,summary,thead{break-after:avoid}img{filter:none;min-width:0;max-width:min(100%,calc(var(--columns,1)*11cm))}.wide,figure{overflow:visible}.long{min-width:0}}
)";

/// Numbers sort by size, prefixes of units and powers of ten included, words as words. Printing unfolds.
constexpr const char* kScript = R"(
const raised={'⁰':0,'¹':1,'²':2,'³':3,'⁴':4,'⁵':5,'⁶':6,'⁷':7,'⁸':8,'⁹':9},prefix={p:1e-12,n:1e-9,'µ':1e-6,m:1e-3,k:1e3,M:1e6};
function size(text){
  const m=text.replace(/−/g,'-').match(/^(-?[\d.]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?(?:\s*±\s*[\d.]+)?\s*(\S*)/);
  if(!m)return null;
  let v=parseFloat(m[1]);
  if(m[2])v*=Math.pow(10,(m[2][0]==='⁻'?-1:1)*parseInt([...m[2]].map(c=>raised[c]??'').join('')));
  const u=m[3].match(/^([pnµmkM])(?=rad|m\b|s\b|N|kg|V|A|Hz)/);
  return u?v*prefix[u[1]]:v;
}
for(const th of document.querySelectorAll('th')){
  th.tabIndex=0;
  const sort=()=>{
    const up=th.getAttribute('aria-sort')!=='ascending',body=th.closest('table').tBodies[0];
    for(const other of th.parentNode.children)other.removeAttribute('aria-sort');
    th.setAttribute('aria-sort',up?'ascending':'descending');
    const key=row=>row.cells[th.cellIndex]?.textContent??'';
    [...body.rows].sort((a,b)=>{
      const x=size(key(a)),y=size(key(b));
      const order=x!==null&&y!==null?x-y:x!==null?-1:y!==null?1:key(a).localeCompare(key(b));
      return up?order:-order;
    }).forEach(row=>body.append(row));
  };
  th.onclick=sort;
  th.onkeydown=e=>{if(e.key==='Enter')sort()};
}
onbeforeprint=()=>document.querySelectorAll('details').forEach(d=>d.open=true);
onhashchange=()=>{const d=document.querySelector(location.hash);if(d&&d.tagName==='DETAILS')d.open=true};
)";

}  // namespace

std::string html_page(const std::string& title, const std::string& markdown,
                      const std::vector<Picture>& pictures) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
         html_line(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" +
         html_body(markdown, pictures) + "<script>" + kScript + "</script>\n</body>\n</html>\n";
}

}  // namespace gapscope::internal::report
