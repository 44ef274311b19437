// A picture in SVG as a PNG file.

/** `scale`: pixels for each unit of the picture. */
export async function png(svg: string, scale = 2): Promise<Blob> {
  const image = new Image()
  // A `data:` address, because a `blob:` address needs the policy `img-src blob:`.
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
