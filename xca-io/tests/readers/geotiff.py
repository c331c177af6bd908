"""Makes and reads GeoTIFF files with rasterio, which is GDAL.

usage: python geotiff.py make FOLDER     a file of each kind, and on stdout a JSON list of what they hold
       python geotiff.py read FILE...    a JSON list of what the library finds
"""

import json
import struct
import sys
from pathlib import Path

import numpy
import rasterio
from rasterio.crs import CRS
from rasterio.transform import from_origin

COLUMNS, ROWS, SIDE, WEST, NORTH = 37, 23, 12.5, 499_000.25, 4_177_000.5


def band(dtype):
    rows, columns = numpy.mgrid[0:ROWS, 0:COLUMNS]
    values = (7 * rows + 3 * columns) % 200 + (0.1 if dtype.startswith("float") else 0)
    return values.astype(dtype)


def make(path, dtype, nodata, crs="EPSG:32633", bands=1, point=False, **options):
    profile = {
        "driver": "GTiff", "width": COLUMNS, "height": ROWS, "count": bands, "dtype": dtype, "nodata": nodata,
        "crs": crs, "transform": from_origin(WEST, NORTH, SIDE, SIDE),
    }
    values = band(dtype)
    if nodata is not None:
        values[::5, ::3] = nodata
    with rasterio.open(path, "w", **profile, **options) as file:
        if point:
            file.update_tags(AREA_OR_POINT="Point")
        file.write(values, 1)
        for number in range(1, bands):
            file.write(numpy.zeros_like(values), number + 1)


LOCAL = CRS.from_proj4("+proj=laea +lat_0=37.7 +lon_0=15 +ellps=GRS80 +units=m")
TILES = {"tiled": True, "blockxsize": 16, "blockysize": 16}
KINDS = [
    ("plain", "float64", -9999.0, {}),
    ("strips", "float32", -9999.0, {"blockysize": 5, "compress": "deflate", "predictor": 3}),
    ("tiles", "float32", -3.4028234663852886e38, TILES | {"compress": "lzw", "predictor": 3}),
    ("doubles", "float64", float("nan"), TILES | {"compress": "deflate", "predictor": 3}),
    ("bytes", "uint8", 255, {"compress": "packbits"}),
    ("signed", "int8", None, {}),
    ("short", "int16", -32768, TILES | {"compress": "lzw", "predictor": 2}),
    ("unsigned", "uint16", None, {"compress": "deflate", "predictor": 2}),
    ("long", "int32", -9999, {"BIGTIFF": "YES"}),
    ("wide", "int64", -9999, {"ENDIANNESS": "BIG"}),
    ("big_endian", "float32", -9999.0, {"ENDIANNESS": "BIG", "compress": "deflate", "predictor": 3}),
    ("point", "float32", -9999.0, {"point": True}),
    ("pixels", "int16", None, TILES | {"bands": 3, "interleave": "pixel"}),
    ("planes", "int16", None, {"bands": 3, "interleave": "band", "compress": "lzw"}),
    ("sparse", "float32", -9999.0, TILES | {"SPARSE_OK": True}),
    ("degrees", "float32", -9999.0, {"crs": "EPSG:4326"}),
    ("local", "float32", -9999.0, {"crs": LOCAL}),
    ("nowhere", "float32", -9999.0, {"crs": None}),
]


def found(path):
    with rasterio.open(path) as file:
        values = file.read(1, masked=True).filled(numpy.nan) if file.dtypes[0].startswith("float") else (
            file.read(1, masked=True).astype("float64").filled(numpy.nan))
        return {
            "name": Path(path).name,
            "type": file.dtypes[0],
            "bands": file.count,
            "crs": file.crs.to_wkt() if file.crs else None,
            "epsg": file.crs.to_epsg() if file.crs else None,
            "transform": list(file.transform)[:6],
            "extents": [file.width, file.height],
            "nodata": str(file.nodata),
            "point": file.tags().get("AREA_OR_POINT") == "Point",
            "values": [struct.pack(">d", value).hex() for value in values.astype("float64").ravel()],
        }


if sys.argv[1] == "make":
    paths = []
    for name, dtype, nodata, options in KINDS:
        paths.append(Path(sys.argv[2]) / f"{name}.tif")
        make(paths[-1], dtype, nodata, **options)
else:
    paths = sys.argv[2:]
print(json.dumps([found(path) for path in paths]))
