"""Reads files with the VTK library and prints as JSON what the library finds in them, every value as its bytes.

usage: python vtk_library.py FILE... (.vti, .vtp, or a collection .pvd)

Where the library complains of anything, even in a warning, this fails with the library's words.
"""

import json
import struct
import sys

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader
from vtkmodules.vtkIOXMLParser import vtkXMLUtilities


def bits(number):
    return struct.pack("<d", number).hex()


def array(found):
    told = {
        "name": found.GetName(),
        "type": found.GetDataTypeAsString(),
        "components": found.GetNumberOfComponents(),
        "tuples": found.GetNumberOfTuples(),
    }
    if found.HasAComponentName():
        told["component_names"] = [found.GetComponentName(index) for index in range(told["components"])]
    if told["type"] == "string":
        return told | {"strings": [found.GetValue(index) for index in range(found.GetNumberOfValues())]}
    return told | {"bytes": bytes(memoryview(found)).hex()}


def arrays(data):
    return [array(data.GetAbstractArray(index)) for index in range(data.GetNumberOfArrays())]


complaints = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(complaints)


def integers(found):
    return [int(found.GetComponent(index, 0)) for index in range(found.GetNumberOfTuples())]


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    if complaints.GetOutput():
        sys.exit(f"VTK complains of {path}: {complaints.GetOutput()}")
    data = reader.GetOutput()
    information = reader.GetOutputInformation(0)
    times = information.Length(Pipeline.TIME_STEPS())
    return data, {
        "times": [bits(information.Get(Pipeline.TIME_STEPS(), index)) for index in range(times)],
        "cells": data.GetNumberOfCells(),
        "points": data.GetNumberOfPoints(),
        "cell_data": arrays(data.GetCellData()),
        "point_data": arrays(data.GetPointData()),
        "field_data": arrays(data.GetFieldData()),
    }


def image(path):
    data, found = read(vtkXMLImageDataReader(), path)
    colouring = data.GetCellData().GetScalars()
    return found | {
        "extent": data.GetExtent(),
        "origin": [bits(value) for value in data.GetOrigin()],
        "spacing": [bits(value) for value in data.GetSpacing()],
        "scalars": colouring and colouring.GetName(),
    }


def polygons(data, found):
    """The number of corners, area, middle and cell type of each polygon, as the library computes them."""
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    areas = sizes.GetOutput().GetCellData().GetArray("Area")
    told = {"corners": [], "areas": [], "middles": [], "cell_types": []}
    for index in range(data.GetNumberOfCells()):
        cell = data.GetCell(index)
        bounds = cell.GetBounds()
        told["corners"].append(cell.GetNumberOfPoints())
        told["areas"].append(areas.GetComponent(index, 0))
        told["middles"].append([(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, bounds[4], bounds[5]])
        told["cell_types"].append(data.GetCellType(index))
    colouring = data.GetCellData().GetScalars()
    return found | told | {"bounds": data.GetBounds(), "scalars": colouring and colouring.GetName()}


def poly_data(path):
    data, found = read(vtkXMLPolyDataReader(), path)
    if data.GetNumberOfPolys():
        return polygons(data, found)
    colouring = data.GetPointData().GetScalars()
    vertices = data.GetVerts()
    return found | {
        "positions": array(data.GetPoints().GetData()),
        "vertices": vertices.GetNumberOfCells(),
        "connectivity": integers(vertices.GetConnectivityArray()),
        "offsets": integers(vertices.GetOffsetsArray()),
        "scalars": colouring and colouring.GetName(),
    }


def collection(path):
    """The reader of collections is ParaView's own; that they are XML, the library can say."""
    file = vtkXMLUtilities.ReadElementFromFile(path)
    inner = file.FindNestedElementWithName("Collection")
    entries = [inner.GetNestedElement(index) for index in range(inner.GetNumberOfNestedElements())]
    return {
        "type": file.GetAttribute("type"),
        "times": [bits(float(entry.GetAttribute("timestep"))) for entry in entries],
        "files": [entry.GetAttribute("file") for entry in entries],
    }


KINDS = {"vti": image, "vtp": poly_data, "pvd": collection}
print(json.dumps([KINDS[path.rsplit(".", 1)[-1]](path) for path in sys.argv[1:]]))
