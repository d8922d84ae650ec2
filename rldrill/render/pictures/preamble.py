"""The Typst functions that pictures call."""

PREAMBLE = r"""
#let picture(width, height, body) = layout(size => {
  let drawn = box(width: width, height: height, { set text(8pt); body })
  if width > size.width { scale(size.width / width * 99%, origin: left, reflow: true, drawn) } else { drawn }
})
#let label(x, y, across, down, ground, size, body) = context {
  let plate = box(fill: ground, inset: 0.8pt, {
    set text(size, top-edge: "cap-height", bottom-edge: "baseline"); body
  })
  let room = measure(plate)
  place(dx: x - across * room.width, dy: y - down * room.height, box(width: room.width, plate))
}
#let time-state(time, ends, name) = box(baseline: 50%, stack(dir: ttb, spacing: 2.5pt,
  ..if time == [] { () } else { (align(center, text(7pt, time)),) },
  align(center, box(stroke: 0.6pt, inset: (x: 6pt, y: 4.5pt), radius: if ends { 0pt } else { 9pt },
    fill: if ends { luma(225) } else { none }, text(8pt, top-edge: "x-height", bottom-edge: "baseline", name))),
  ..if time == [] { () } else { (hide(text(7pt)[$t$]),) }))
#let time-arrow(action, reward) = context {
  let above = text(8pt, if action == none { [] } else { action })
  let below = text(8pt, if reward == none { [] } else { reward })
  let width = calc.max(22pt, measure(above).width + 8pt, measure(below).width + 8pt)
  box(baseline: 50%, stack(dir: ttb, spacing: 2.5pt,
    box(width: width, height: 8pt, align(center + bottom, above)),
    box(width: width, height: 5pt, {
      place(dy: 2.5pt, line(length: width - 3pt, stroke: 0.6pt))
      place(dx: width - 5.5pt, dy: 0.8pt, polygon(fill: black, (0pt, 0pt), (5pt, 1.7pt), (0pt, 3.4pt)))
    }),
    box(width: width, height: 8pt, align(center + top, below))))
}
#let timeline(..steps) = block(par(leading: 0.8em, justify: false, steps.pos().join(sym.zws)))
#let beside(..bodies) = block(breakable: false, width: 100%, layout(size => {
  let bodies = bodies.pos()
  let gap = 1.2em.to-absolute()
  let widths = bodies.map(body => measure(body).width)
  let room = size.width - gap * (bodies.len() - 1)
  if widths.sum() <= room {
    grid(columns: widths, column-gutter: gap, ..bodies)
  } else if widths.sum() * 0.8 <= room {
    grid(columns: widths.map(width => width / widths.sum() * room), column-gutter: gap, ..bodies)
  } else { bodies.map(body => block(body)).join() }
}))
"""
