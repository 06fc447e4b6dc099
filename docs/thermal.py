#!/usr/bin/python3
"""Reads form factors, checks them, and solves the thermal enclosure again.

Usage: thermal.py SCENE.json F.h5 SOLUTION.csv

F.h5 and SOLUTION.csv are what `radiosity form-factors` and `radiosity solve` wrote with the same
options on patches, tolerance and seed. Needs python3-h5py and python3-scipy.
"""

import csv
import json
import sys

import h5py
import numpy as np
import scipy.sparse
import scipy.sparse.linalg

STEFAN_BOLTZMANN = 5.670374419e-8  # W/(m² K⁴)


def read_form_factors(path):
    """F as a sparse matrix, areas in m², the surface of each patch, names of the surfaces."""
    with h5py.File(path) as file:
        group = file["form_factors"]
        area = file["patches/area"][:]
        factors = scipy.sparse.csr_matrix(
            (group["data"][:], group["indices"][:], group["indptr"][:]), shape=(area.size, area.size)
        )
        return factors, area, file["patches/surface"][:], file["surfaces/name"].asstr()[:]


def read_materials(path, names):
    """Emissivity and temperature in K of each surface; 0 K where none is given."""
    with open(path) as file:
        scene = json.load(file)
    material = {s["name"]: scene["materials"][s["material"]] for s in scene["surfaces"]}
    emissivity = np.array([material[name]["emissivity"] for name in names])
    temperature = np.array([material[name].get("temperature", 0) for name in names])
    return emissivity, temperature


def read_net_flux(path):
    """B - H of each patch as the program has found it, W/m²."""
    with open(path) as file:
        return np.array([float(row["net_0"]) for row in csv.DictReader(file)])


def main(scene_path, factors_path, solution_path):
    F, area, surface, names = read_form_factors(factors_path)
    print(f"{area.size} patches, {F.nnz} form factors above 0")

    # A_i F_ij = A_j F_ji
    G = scipy.sparse.diags(area) @ F
    reciprocity = abs(G - G.T).max() / G.max()
    print(f"reciprocity: largest |A_i F_ij - A_j F_ji| is {reciprocity:.1e} of the largest A_i F_ij")

    # In a closed scene all that leaves a patch arrives at another.
    closure = abs(F.sum(axis=1) - 1).max()
    print(f"closure: largest |1 - row sum| is {closure:.1e}")

    # B = ε σ T⁴ + (1 - ε) F B, and what a patch loses is B - F B.
    emissivity, temperature = read_materials(scene_path, names)
    emitted = (emissivity * STEFAN_BOLTZMANN * temperature**4)[surface]
    reflectance = (1 - emissivity)[surface]
    system = scipy.sparse.identity(area.size) - scipy.sparse.diags(reflectance) @ F
    B = scipy.sparse.linalg.spsolve(system.tocsc(), emitted)
    net_flux = B - F @ B

    print("net heat lost by")
    for s, name in enumerate(names):
        print(f"  {name:<10}{(area * net_flux)[surface == s].sum():12.4f} W")
    difference = abs(net_flux - read_net_flux(solution_path)).max() / emitted.max()
    print(f"largest difference from the program's net flux: {difference:.1e} of the largest εσT⁴")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
