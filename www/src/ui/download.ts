// Files for people: saved by the browser, drawn from a picture.

import { el } from './dom'

/** Saves a file. Frames without allow-downloads ignore it silently. */
export function save(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], { type }))
  const link = el('a', { href: url, download: name })
  document.body.append(link)
  link.click()
  link.remove()
  setTimeout(() => URL.revokeObjectURL(url), 10_000)
}

/** A picture as PNG, with so many pixels for each unit of it. */
export async function png(svg: string, scale = 2): Promise<Blob> {
  const image = new Image()
  // A data address: that of a blob needs the policy `img-src blob:`.
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`
  await image.decode()
  const canvas = document.createElement('canvas')
  canvas.width = scale * image.naturalWidth
  canvas.height = scale * image.naturalHeight
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height)
  return new Promise((resolve, reject) =>
    canvas.toBlob(blob => (blob ? resolve(blob) : reject(new Error('PNG'))), 'image/png'),
  )
}
