#include "report/html_page.h"

namespace gapscope::internal::report {
namespace {

/// Pictures are drawn on white: dark pages turn their lightness and keep their hues.
constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--ink:#1b1f24;--soft:#57606a;--paper:#fff;--line:#d0d7de;--card:#f3f6f9;--mark:#0b62a8}
@media(prefers-color-scheme:dark){:root{--ink:#e4e7eb;--soft:#a0a8b2;--paper:#15181c;--line:#3a424c;--card:#1f242b;--mark:#6cb2ee}
figure svg{filter:invert(.91) hue-rotate(180deg)}}
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
.wide{overflow-x:auto;background:linear-gradient(90deg,var(--paper) 40%,transparent) 0 0/3rem 100% no-repeat local,linear-gradient(270deg,var(--paper) 40%,transparent) 100% 0/3rem 100% no-repeat local,linear-gradient(90deg,#8887,transparent) 0 0/.8rem 100% no-repeat,linear-gradient(270deg,#8887,transparent) 100% 0/.8rem 100% no-repeat}
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
figure svg{display:block;width:100%;min-width:calc(var(--columns,1)*23rem);max-width:calc(var(--columns,1)*46rem);height:auto;background:#fff;touch-action:pan-x pan-y}
.tip{position:sticky;left:0;min-height:1.4em;font-size:.85rem;color:var(--soft);overflow-wrap:anywhere}
.about{color:var(--soft);margin:-.5rem 0 .6rem;overflow-wrap:anywhere}
.badge{display:inline-block;padding:.05rem .7rem;margin:0 .4rem .6rem 0;border-radius:1rem;font-weight:600;color:#fff;background:#57606a}
.badge.good{background:#1a7f37}.badge.limited{background:#9a6700}.badge.bad{background:#c0252b}
@media(max-width:30rem){body{padding:.7rem}.card{padding:.7rem .8rem}}
@media print{body{max-width:none;padding:0;font-size:11pt}figure,.card,tr{break-inside:avoid}h3,summary,thead{break-after:avoid}figure svg{filter:none;min-width:0;max-width:min(100%,calc(var(--columns,1)*11cm))}.tip{display:none}.badge{border:1px solid #000;color:#000;background:none}.wide,figure{overflow:visible}.long{min-width:0}}
)";

/// Numbers sort by size, prefixes of units and powers of ten included, words as words. Printing unfolds.
constexpr const char* kScript = R"js(
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
const plots=[...document.querySelectorAll('.plot')],n=(e,k)=>parseFloat(e.getAttribute(k)),d=(e,k)=>parseFloat(e.dataset[k]);
function lines(p){  // of a panel, as points in pixels; its grid has two points a line
  return p.lines??=[...p.ownerSVGElement.querySelectorAll(`polyline[clip-path="url(#${p.dataset.clip})"]`)].map(l=>
    ({colour:l.getAttribute('stroke'),at:l.getAttribute('points').split(' ').map(q=>q.split(',').map(Number))})).filter(l=>l.at.length>2);
}
function value(p,x){  // of each line at a pixel
  const found=[];
  for(const l of lines(p)){
    const i=l.at.findIndex((q,k)=>k>0&&(l.at[k-1][0]-x)*(q[0]-x)<=0);
    if(i<1)continue;
    const [a,b]=[l.at[i-1],l.at[i]],y=a[0]===b[0]?a[1]:a[1]+(b[1]-a[1])*(x-a[0])/(b[0]-a[0]);
    found.push([l.colour,d(p,'yhigh')-(y-n(p,'y'))/n(p,'height')*(d(p,'yhigh')-d(p,'ylow'))]);
  }
  return found;
}
const digits=v=>v.toPrecision(4).replace('-','−');
function cursor(of,at){
  for(const p of plots){
    const share=(at-d(p,'xlow'))/(d(p,'xhigh')-d(p,'xlow')),here=p.dataset.x===of.dataset.x&&share>=0&&share<=1;
    if(!here){p.mark?.setAttribute('visibility','hidden');continue}
    const x=n(p,'x')+share*n(p,'width');
    if(!p.mark){
      p.mark=document.createElementNS(p.namespaceURI,'line');
      for(const [k,v] of [['y1',n(p,'y')],['y2',n(p,'y')+n(p,'height')],['stroke','#57606a'],['stroke-width',2],['pointer-events','none']])p.mark.setAttribute(k,v);
      p.after(p.mark);
    }
    p.mark.setAttribute('x1',x);p.mark.setAttribute('x2',x);p.mark.setAttribute('visibility','visible');
    const tip=tips.get(p.ownerSVGElement),values=value(p,x);
    tip.textContent||=`${p.dataset.x}: ${digits(at)}`;
    if(values.length)tip.append(`; ${p.dataset.y}:`);
    for(const [colour,v] of values){
      const s=document.createElement('span');
      s.textContent=` ■ ${digits(v)}`;s.style.color=colour;
      tip.append(s);
    }
  }
}
const tips=new Map();
for(const svg of document.querySelectorAll('figure svg')){
  const tip=document.createElement('div'),whole=svg.getAttribute('viewBox').split(' ').map(Number);
  tip.className='tip';svg.after(tip);tips.set(svg,tip);
  let box=[...whole],held=null;
  const show=()=>svg.setAttribute('viewBox',box.join(' '));
  const place=e=>{const r=svg.getBoundingClientRect();return [box[0]+(e.clientX-r.left)/r.width*box[2],box[1]+(e.clientY-r.top)/r.height*box[3]]};
  svg.addEventListener('wheel',e=>{
    if(!e.ctrlKey)return;
    e.preventDefault();
    const [x,y]=place(e),f=Math.min(Math.exp(e.deltaY/400),whole[2]/box[2]);
    box=[x-(x-box[0])*f,y-(y-box[1])*f,box[2]*f,box[3]*f];
    show();
  },{passive:false});
  svg.addEventListener('pointerdown',e=>{held=box[2]<whole[2]?place(e):null});
  svg.addEventListener('pointermove',e=>{
    const [x,y]=place(e);
    if(held&&e.buttons){box[0]+=held[0]-x;box[1]+=held[1]-y;return show()}
    const p=plots.find(q=>q.ownerSVGElement===svg&&x>=n(q,'x')&&x<=n(q,'x')+n(q,'width')&&y>=n(q,'y')&&y<=n(q,'y')+n(q,'height'));
    for(const t of tips.values())t.textContent='';
    if(p)cursor(p,d(p,'xlow')+(x-n(p,'x'))/n(p,'width')*(d(p,'xhigh')-d(p,'xlow')));
  });
  svg.addEventListener('pointerleave',()=>{for(const p of plots)p.mark?.setAttribute('visibility','hidden');for(const t of tips.values())t.textContent=''});
  svg.addEventListener('dblclick',()=>{box=[...whole];show()});
}
onbeforeprint=()=>document.querySelectorAll('details').forEach(d=>d.open=true);
onhashchange=()=>{const d=document.querySelector(location.hash);if(d&&d.tagName==='DETAILS')d.open=true};
)js";

std::string head_html(const PageHead& head) {
  std::string text = head.about.empty() ? "" : "<p class=\"about\">" + html_line(head.about) + "</p>\n";
  for (const Badge& b : head.badges)
    text += "<span class=\"badge " + std::string(b.kind) + "\">" + html_line(b.text) + "</span>";
  return text + (head.badges.empty() ? "" : "\n");
}

}  // namespace

std::string html_page(const PageHead& head, const std::string& markdown,
                      const std::vector<Picture>& pictures) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
         html_line(head.title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" +
         html_body(markdown, pictures, head_html(head), head.carrying) + "<script>" + kScript +
         "</script>\n</body>\n</html>\n";
}

}  // namespace gapscope::internal::report
